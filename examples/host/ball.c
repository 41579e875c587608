/* A simulator of your own in C: the paper's ball at a step of 2 ms.
 *
 * A solid sphere falls from 10 cm at 0.5 m/s, bounces, slips and rolls. Its steps are semi-implicit; what happens to
 * the contact inside them is footfall's. The exact run is `footfall run rolling-sphere`. */
#include <footfall.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(footfall_status status) {
    if (status == FOOTFALL_OK) return;
    fprintf(stderr, "footfall: %s\n", footfall_last_error());
    exit(EXIT_FAILURE);
}

int main(void) {
    const double mass = 0.154, radius = 0.0165, gravity = 9.81, dt = 2e-3, end = 1.0;
    const double inertia = 2.0 / 5.0 * mass * radius * radius;
    const footfall_parameter normal[] = {{"stiffness", 8.5e6}, {"damping", 3.1e3}};
    const footfall_parameter friction[] = {
        {"stiffness", 12.75e6}, {"damping", 3.1e3}, {"coefficient", 0.2}, {"viscous", 0.1}};
    const footfall_law law = {"azad-featherstone", normal, 2, "azad-featherstone", friction, 4};
    footfall_contact_set* contacts;
    double position[3] = {0, 0, 0.1}, velocity[3] = {0.5, 0, 0}, spin[2] = {0, 0}; /* about x and y */
    double taken = 0, held = 0, residual = 0;
    /* The Delassus matrix of a ball: a push along a tangent turns it too. */
    const double tangent = 1 / mass + radius * radius / inertia;
    const double delassus[9] = {tangent, 0, 0, 0, tangent, 0, 0, 0, 1 / mass};
    const double energy = mass * gravity * position[2] + 0.5 * mass * 0.25;
    double left;
    int step, k, steps = (int)floor(end / dt + 0.5);

    check(footfall_contact_set_create(FOOTFALL_INTERFACE, &law, 1, 0, 0, &contacts));
    for (step = 0; step < steps; ++step) {
        const double depth = radius - position[2];
        /* Of the bottom point: v + omega x (0, 0, -radius). */
        const double at_contact[3] = {velocity[0] - radius * spin[1], velocity[1] + radius * spin[0], velocity[2]};
        const double free_acceleration[3] = {0, 0, -gravity};
        double J[3], JJ[3];
        footfall_host_step host = {0};
        footfall_step_result result = {0};
        host.dt = dt;
        host.depth = &depth;
        host.velocity = at_contact;
        host.free_acceleration = free_acceleration;
        host.delassus = delassus;
        result.impulse = J;
        result.double_impulse = JJ;
        check(footfall_contact_set_step(contacts, &host, &result));
        for (k = 0; k < 3; ++k) {
            position[k] += dt * velocity[k] + 0.5 * dt * dt * free_acceleration[k] + JJ[k] / mass;
            velocity[k] += dt * free_acceleration[k] + J[k] / mass;
        }
        spin[0] += radius * J[1] / inertia;
        spin[1] -= radius * J[0] / inertia;
        taken += result.taken;
        held = result.held;
        residual = fmax(residual, fabs(result.residual));
    }
    footfall_contact_set_destroy(contacts);
    left = mass * gravity * position[2] + held + taken - energy;
    for (k = 0; k < 3; ++k) left += 0.5 * mass * velocity[k] * velocity[k];
    for (k = 0; k < 2; ++k) left += 0.5 * inertia * spin[k] * spin[k];
    printf("after %.1f s at x = %.6f m; contacts took %.3f mJ; the account misses %.1e mJ\n", end, position[0],
           1e3 * taken, 1e3 * left);
    return fabs(left) < 1e-6 * energy && residual < 1e-6 * energy ? EXIT_SUCCESS : EXIT_FAILURE;
}

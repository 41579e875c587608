/* footfall in the loop of your own simulator: contacts that stay right at one millisecond.
 *
 * The C interface of footfall::ContactSet (include/footfall/host/contact_set.hpp, docs/contact-set.md), for C99, C++,
 * Fortran, Rust and whatever else calls C. Link with the CMake target footfall::host, or with libfootfall_host.a and
 * the C++ run-time library; nothing else is needed.
 *
 * Arrays are plain, row by row, and the caller's. Numbers are in SI units. Vectors of a contact are in its own frame:
 * two tangents, then the ground's normal. No call throws; each but the last few returns a status, and
 * footfall_last_error() says what was wrong. A set may be used by one thread at a time; different sets by different
 * threads. */
#ifndef FOOTFALL_H
#define FOOTFALL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header. A set is made only by a library of the same. */
#define FOOTFALL_INTERFACE 1
/* Of the library that is linked. */
int footfall_interface(void);
/* "0.1.0" */
const char* footfall_version(void);

typedef enum footfall_status {
    FOOTFALL_OK = 0,
    FOOTFALL_INVALID_INPUT = 1,   /* an argument cannot be used; nothing has changed */
    FOOTFALL_WRONG_INTERFACE = 2, /* header and library do not go together */
    FOOTFALL_OUT_OF_MEMORY = 3,
    FOOTFALL_FAILED = 4 /* a defect of the library */
} footfall_status;

/* What the last call of this thread that failed has to say; "" where none has. Valid until the thread's next call. */
const char* footfall_last_error(void);

/* ---- laws ---------------------------------------------------------------------------------------------------------
 */

/* A parameter by its name, "stiffness", in the unit that `footfall laws` tells. */
typedef struct footfall_parameter {
    const char* name;
    double value;
} footfall_parameter;

/* The laws of one contact by their names, "azad-featherstone". Parameters that have a default may be left out.
 * `friction` may be NULL: none. */
typedef struct footfall_law {
    const char* normal;
    const footfall_parameter* normal_parameters;
    size_t normal_parameter_count;
    const char* friction;
    const footfall_parameter* friction_parameters;
    size_t friction_parameter_count;
} footfall_law;

/* ---- sets ---------------------------------------------------------------------------------------------------------
 */

typedef struct footfall_contact_set footfall_contact_set;

/* A set of `contacts` contacts, one law for each. `interface_version` is FOOTFALL_INTERFACE. `tolerance`: relative,
 * 1e-13 to 1e-2, or 0 for the default, 1e-6. `max_evaluations`: in one step, or 0 for the default. */
footfall_status footfall_contact_set_create(int interface_version, const footfall_law* laws, size_t contacts,
                                            double tolerance, int64_t max_evaluations, footfall_contact_set** set);
/* NULL is allowed. */
void footfall_contact_set_destroy(footfall_contact_set* set);
footfall_status footfall_contact_set_copy(const footfall_contact_set* set, footfall_contact_set** copy);

/* What a host gives for a step of n contacts. */
typedef struct footfall_host_step {
    double dt;                       /* [s], >= 0 */
    const double* depth;             /* n [m], > 0 in the ground; -INFINITY is far above it */
    const double* velocity;          /* of the contact points against the ground, 3 n [m/s]; normal: > 0 away from it */
    const double* free_acceleration; /* what `velocity` would change by without the contacts, 3 n [m/s^2] */
    const double* delassus;          /* J M^-1 J^T, 3n x 3n [1/kg], symmetric; may be singular */
    /* These may be NULL. */
    const double* ground_velocity; /* 3 n [m/s], for the account alone */
    const double* frame_spin;      /* how fast each frame turns about its normal, n [rad/s] */
    const double* radius;          /* of the spheres, n [m]; for laws with torques, as are */
    const double* spin;            /* about the normal, n [rad/s] */
    const double* rolling;         /* in the plane, 2 n [rad/s] */
} footfall_host_step;

/* What a step gives back. The arrays are yours; those that you do not want are NULL. */
typedef struct footfall_step_result {
    double* impulse;         /* integral of the force on the body, 3 n [N s] */
    double* double_impulse;  /* integral of the impulse so far, 3 n [N s^2] */
    double* angular_impulse; /* of torques that laws give: rolling, rolling, spin, 3 n [N m s] */
    /* The rest is written. Energies in J, over all contacts. */
    double held_before;     /* by springs and bristles at the start, at the depth and velocity given */
    double held;            /* by springs and bristles at the end */
    double taken;           /* by dampers and clutches, and what no force paid for, within the step */
    double contact_work;    /* of the contact forces on the bodies, in their motion against the ground */
    double ground_work;     /* of the contact forces on the bodies, in the ground's own motion */
    double residual;        /* held + taken + contact_work - held_before: what the account misses */
    double energy_scale;    /* what `residual` and the tolerance are relative to */
    double unresolved_time; /* at the end of the step, taken by one implicit step [s]; 0: all was resolved */
    double unresolved_loss; /* what the implicit step has taken and no channel accounts for */
    int64_t evaluations;    /* of the contacts' equations */
    size_t events;          /* footfall_contact_set_event() has them */
} footfall_step_result;

footfall_status footfall_contact_set_step(footfall_contact_set* set, const footfall_host_step* host,
                                          footfall_step_result* result);

typedef enum footfall_event_kind {
    FOOTFALL_TOUCHDOWN = 0,
    FOOTFALL_STICK = 1,
    FOOTFALL_SLIP = 2,
    FOOTFALL_SEPARATION = 3,
    FOOTFALL_RECOVERED = 4
} footfall_event_kind;
typedef struct footfall_event {
    double time; /* since the step's start [s] */
    int contact;
    footfall_event_kind kind;
} footfall_event;
/* Event `index` of the last step, in order of time. */
footfall_status footfall_contact_set_event(const footfall_contact_set* set, size_t index, footfall_event* event);

/* The energies of one contact after the last step [J]: what is held, what has been taken within the step. */
typedef struct footfall_contact_energy {
    double normal_spring, tangential_spring;         /* held */
    double normal_damper, tangential_damper, clutch; /* taken */
    double stiffness_change;                         /* taken, and no force has paid for it */
} footfall_contact_energy;
footfall_status footfall_contact_set_energy(const footfall_contact_set* set, size_t contact,
                                            footfall_contact_energy* energy);

/* ---- what the contacts remember -------------------------------------------------------------------------------------
 */

size_t footfall_contact_set_contacts(const footfall_contact_set* set);
size_t footfall_contact_set_states(const footfall_contact_set* set); /* numbers in all */
/* Phases: 0 flight, 1 stick, 2 slip, 3 recovering; one for each contact. */
footfall_status footfall_contact_set_save(const footfall_contact_set* set, double* states, int* phases);
footfall_status footfall_contact_set_restore(footfall_contact_set* set, const double* states, const int* phases);

#ifdef __cplusplus
}
#endif

#endif

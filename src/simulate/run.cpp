#include "footfall/simulate/run.hpp"

namespace footfall {

template <class Normal>
Run run_under(const Simulation& simulation);  // run_<normal law>.cpp

Run run(const Simulation& simulation) {
    check(simulation);
    return std::visit([&]<class Normal>(const Normal&) { return run_under<Normal>(simulation); },
                      simulation.contacts.front().normal);
}

}  // namespace footfall

// The paper's ball driven by ARKODE's explicit Runge-Kutta pair of Dormand & Prince, order 5(4).
#pragma once

#include <arkode/arkode_erkstep.h>

#include "sundials_sphere.hpp"

namespace oracle {

class ArkodeSphere : public SundialsSphere {
public:
    ArkodeSphere(const Ball<double>& ball, double tolerance) : SundialsSphere(ball, tolerance) {
        memory_ = ERKStepCreate(rhs, 0, y_, context_);
        std::array<int, 2> falling{-1, -1};
        require(ERKStepSetTableNum(memory_, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
        require(ERKStepSVtolerances(memory_, tolerance, absolute_), "ERKStepSVtolerances");
        require(ERKStepSetUserData(memory_, static_cast<SundialsSphere*>(this)), "ERKStepSetUserData");
        require(ERKStepRootInit(memory_, 2, roots), "ERKStepRootInit");
        require(ERKStepSetRootDirection(memory_, falling.data()), "ERKStepSetRootDirection");
        require(ERKStepSetNoInactiveRootWarn(memory_), "ERKStepSetNoInactiveRootWarn");
        require(ERKStepSetMaxNumSteps(memory_, step_limit), "ERKStepSetMaxNumSteps");
    }
    ~ArkodeSphere() override { ERKStepFree(&memory_); }

private:
    bool evolve(double& t, double end, std::array<int, 2>& found) override {
        require(ERKStepReInit(memory_, rhs, t, y_), "ERKStepReInit");
        require(ERKStepSetStopTime(memory_, end), "ERKStepSetStopTime");
        if (require(ERKStepEvolve(memory_, end, y_, &t, ARK_NORMAL), "ERKStepEvolve") != ARK_ROOT_RETURN) return false;
        require(ERKStepGetRootInfo(memory_, found.data()), "ERKStepGetRootInfo");
        return true;
    }

    void count(TimedRun& run) const override {
        long steps = 0, evaluations = 0;
        ERKStepGetNumSteps(memory_, &steps);
        ERKStepGetNumRhsEvals(memory_, &evaluations);
        run.steps += steps;
        run.evaluations += evaluations;
    }

    void* memory_ = nullptr;
};

}  // namespace oracle

// The paper's ball driven by CVODE's Adams method, orders 1 to 12, with Newton iteration.
#pragma once

#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "sundials_sphere.hpp"

namespace oracle {

class CvodeSphere : public SundialsSphere {
public:
    CvodeSphere(const Ball<double>& ball, double tolerance) : SundialsSphere(ball, tolerance) {
        memory_ = CVodeCreate(CV_ADAMS, context_);
        require(CVodeInit(memory_, rhs, 0, y_), "CVodeInit");
        matrix_ = SUNDenseMatrix(dimension, dimension, context_);
        solver_ = SUNLinSol_Dense(y_, matrix_, context_);
        std::array<int, 2> falling{-1, -1};
        require(CVodeSVtolerances(memory_, tolerance, absolute_), "CVodeSVtolerances");
        require(CVodeSetLinearSolver(memory_, solver_, matrix_), "CVodeSetLinearSolver");
        require(CVodeSetUserData(memory_, static_cast<SundialsSphere*>(this)), "CVodeSetUserData");
        require(CVodeRootInit(memory_, 2, roots), "CVodeRootInit");
        require(CVodeSetRootDirection(memory_, falling.data()), "CVodeSetRootDirection");
        require(CVodeSetNoInactiveRootWarn(memory_), "CVodeSetNoInactiveRootWarn");
        require(CVodeSetMaxNumSteps(memory_, step_limit), "CVodeSetMaxNumSteps");
    }
    ~CvodeSphere() override {
        CVodeFree(&memory_);
        SUNLinSolFree(solver_);
        SUNMatDestroy(matrix_);
    }

private:
    bool evolve(double& t, double end, std::array<int, 2>& found) override {
        require(CVodeReInit(memory_, t, y_), "CVodeReInit");
        require(CVodeSetStopTime(memory_, end), "CVodeSetStopTime");
        if (require(CVode(memory_, end, y_, &t, CV_NORMAL), "CVode") != CV_ROOT_RETURN) return false;
        require(CVodeGetRootInfo(memory_, found.data()), "CVodeGetRootInfo");
        return true;
    }

    void count(TimedRun& run) const override {
        long steps = 0, evaluations = 0, for_jacobian = 0;
        CVodeGetNumSteps(memory_, &steps);
        CVodeGetNumRhsEvals(memory_, &evaluations);
        CVodeGetNumLinRhsEvals(memory_, &for_jacobian);
        run.steps += steps;
        run.evaluations += evaluations + for_jacobian;
    }

    SUNMatrix matrix_ = nullptr;
    SUNLinearSolver solver_ = nullptr;
    void* memory_ = nullptr;
};

}  // namespace oracle

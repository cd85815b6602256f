#pragma once

/// Signals that stop a step between two iterations, without waiting for its end.

#include "bind.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {

/// `Simulation::step` without the interpreter's lock. In the main thread Ctrl-C raises KeyboardInterrupt,
/// with the simulation at its last good step; so do the signals that `interrupt_on` names. A handler of
/// SIGINT of the user's own is left alone: it is called after the step.
StepReport step_interruptibly(Simulation& simulation, double h);

void bind_interruption(py::module_& m);

}  // namespace tissu::bind

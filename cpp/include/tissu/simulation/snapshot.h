#pragma once

/// Everything that the next step of a simulation depends on and its scene does not tell, as plain numbers.

#include <cstdint>
#include <string>
#include <vector>

#include "tissu/edit/topology.h"
#include "tissu/state/state.h"

namespace tissu {

struct Snapshot {
  State state;
  bool settled = true;                    ///< eliminated nodes stand in their places
  double time_before = 0.0;               ///< the latest step began [s]
  std::vector<double> velocities_before;  ///< and had these velocities: reactions are computed from them
  std::vector<double> straining;          ///< State::straining of that step; so are these
  std::vector<double> integrator;         ///< Integrator::memory()
  std::vector<double> energy_watch;       ///< EnergyWatch::reference(); empty where energy is not watched
  std::vector<BodyTopology> bodies;       ///< what edits left of them; only of worlds that can be edited
};

}  // namespace tissu

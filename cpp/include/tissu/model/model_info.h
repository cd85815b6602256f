#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace tissu {

/// Whether a model can represent something, and how, in a few words.
struct Ability {
  enum class Can : std::uint8_t { no, partly, yes };
  Can can;
  std::string_view how;
};

/// What a model says of itself: the docs' table of models is made of these.
struct ModelInfo {
  std::string_view name;                   ///< as scenes write it
  std::string_view form;                   ///< what it computes, in a few words
  std::vector<std::string_view> laws;      ///< that it takes; empty: any
  std::vector<std::string_view> elements;  ///< that it takes; empty: any
  Ability poisson;                         ///< Poisson's ratio is a parameter, and is what comes out
  Ability rotation;                        ///< large rotations
  Ability strain;                          ///< large strains
  Ability inversion;                       ///< cells turned inside out come back
  Ability topology;                        ///< cells may be removed while it runs
};

}  // namespace tissu

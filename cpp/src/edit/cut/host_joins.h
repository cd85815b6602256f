#pragma once

/// Which hosts hang together by material.

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

class HostJoins {
 public:
  HostJoins(const Hosts& hosts, const Material& material) : hosts_(hosts), material_(material) {}

  /// Hosts that share an unopened face of material with this one.
  std::vector<std::int32_t> of(std::int32_t cell);

 private:
  using Face = std::array<std::int32_t, 3>;  ///< vertices, ascending
  [[nodiscard]] bool is_whole(std::int32_t cell) const { return !material_.cells.contains(cell); }
  const std::vector<Face>& faces_of(std::int32_t cell);
  [[nodiscard]] bool is_simplex(std::int32_t cell) const;
  bool share_face(std::int32_t a, std::int32_t b);

  const Hosts& hosts_;
  const Material& material_;
  std::unordered_map<std::int32_t, std::vector<Face>> faces_;  ///< unopened, ascending
};

}  // namespace tissu

#include "folded_sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tissu::bench {

std::vector<Box> folded_sheet(int cells, int layers, double apart, double grown, double time) {
  const double width = static_cast<double>(cells) / layers;
  const auto at = [&](int i, int j) {
    const double layer = std::min(std::floor(i / width), static_cast<double>(layers - 1));
    const double along = i - layer * width;
    const double x = static_cast<int>(layer) % 2 == 0 ? along : width - along;
    const double wave = 0.3 * std::sin(2.0 * std::numbers::pi * (x / 20.0 + 0.01 * time));
    return Vec3(x, j, layer * apart + wave);
  };
  std::vector<Box> boxes;
  boxes.reserve(2 * static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (const Vec3& third : {at(i, j), at(i + 1, j + 1)}) {
        Box box = Box::none();
        for (const Vec3& corner : {at(i + 1, j), at(i, j + 1), third}) box.add(corner);
        box.grow(grown);
        boxes.push_back(box);
      }
    }
  }
  return boxes;
}

}  // namespace tissu::bench

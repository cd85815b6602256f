#include "parted_face_loads.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "left_faces.h"
#include "renewed_load.h"
#include "tissu/base/index.h"
#include "tissu/element/reference_cell.h"
#include "tissu/element/reference_part.h"

namespace tissu {
namespace {

using Nodes = std::span<const std::int32_t>;

constexpr double kNothing = 1e-14;  ///< of the largest load of a node: round-off

/// What each node of a face gets for each unit of the load.
struct Given {
  std::vector<std::int32_t> nodes;
  std::vector<Vec3> values;
};

Vec3 sum_of(const Given& given) {
  return std::accumulate(given.values.begin(), given.values.end(), Vec3(Vec3::Zero()));
}

class FaceLoad {
 public:
  FaceLoad(const LoadDescription& load, const CutState& cut)
      : load_(load), cut_(cut), is_changed_(at(cut.hosts.node_count()), 0) {
    std::vector<FaceLeft> left = faces_left(cut, load.faces);
    auto next = left.begin();
    for (const FaceCells& some : load.faces) {
      const auto count = at(find_element(some.element)->nodes);
      for (std::size_t i = 0; i + count <= some.nodes.size(); i += count)
        faces_.push_back({&some, Nodes(some.nodes).subspan(i, count), std::move(*next++)});
    }
    for (const Face& face : faces_) {
      if (is_as_before(face)) continue;
      mark(face.nodes);
      for (const FacePart& part : face.left.parts) mark(part.nodes);
    }
  }

  /// The sums at the nodes of all faces that are not as they were.
  std::map<std::int32_t, Vec3> find() {
    std::map<std::int32_t, Vec3> sums;
    const auto changed = [&](std::int32_t node) { return is_changed_[at(node)] != 0; };
    for (std::size_t node = 0; node < is_changed_.size(); ++node) {
      if (is_changed_[node] != 0) sums.emplace(static_cast<std::int32_t>(node), Vec3::Zero());
    }
    for (const Face& face : faces_) {
      if (std::ranges::none_of(face.nodes, changed)) continue;
      for (const Given& given : is_as_before(face) ? std::vector{whole(face)} : left_of(face)) {
        for (std::size_t i = 0; i < given.nodes.size(); ++i) {
          const auto sum = sums.find(given.nodes[i]);
          if (sum != sums.end()) sum->second += given.values[i];
        }
      }
    }
    return sums;
  }

 private:
  struct Face {
    const FaceCells* type;
    Nodes nodes;
    FaceLeft left;
  };

  void mark(Nodes nodes) {
    for (const std::int32_t node : nodes) is_changed_[at(node)] = 1;
  }

  /// Whether a cell has the face with its own nodes, all of it.
  static bool is_as_before(const Face& face) {
    if (face.left.parts.size() != 1 || !face.left.parts.front().pieces.empty()) return false;
    return std::ranges::is_permutation(face.left.parts.front().nodes, face.nodes);
  }

  [[nodiscard]] Given whole(const Face& face) const {
    return given_by({face.type->element, {face.nodes.begin(), face.nodes.end()}, {}}, face);
  }

  /// What the parts of a face give, with its normal. If nothing of it is missing, the sum is that of the
  /// whole face: rules on parts of a curved one differ a little from the rule on all of it.
  [[nodiscard]] std::vector<Given> left_of(const Face& face) const {
    std::vector<Given> all;
    Vec3 missing = sum_of(whole(face));
    const Vec3 outward = missing;
    double size = 0.0;
    for (const FacePart& part : face.left.parts) {
      Given& given = all.emplace_back(given_by(part, face));
      if (sum_of(given).dot(outward) < 0.0) {
        for (Vec3& value : given.values) value = -value;
      }
      missing -= sum_of(given);
      for (const Vec3& value : given.values) size += value.norm();
    }
    if (face.left.share < 1.0 || (all.size() == 1 && face.left.parts.front().pieces.empty())) return all;
    if (!(size > 0.0)) return all;
    for (Given& given : all) {
      for (Vec3& value : given.values) value += value.norm() / size * missing;
    }
    return all;
  }

  [[nodiscard]] Given given_by(const FacePart& part, const Face& face) const {
    Given given{part.nodes, {}};
    FaceCells alone{std::string(part.element), {}, face.type->thickness};
    std::vector<double> places;
    for (const std::int32_t node : part.nodes) {
      alone.nodes.push_back(static_cast<std::int32_t>(alone.nodes.size()));
      const Vec3 place = block(cut_.hosts.rest(), node);
      places.insert(places.end(), place.data(), place.data() + 3);
    }
    std::vector<double> sums(load_.along_normals ? places.size() : part.nodes.size(), 0.0);
    const auto add = [&](const ReferenceCell* rule) {
      if (load_.along_normals) {
        add_normals(alone, places, sums, rule);
      } else {
        add_areas(alone, places, sums, rule);
      }
    };
    if (part.pieces.empty()) add(nullptr);
    for (const auto& piece : part.pieces) {
      const ReferenceCell rule = reference_part(part.element, piece);
      add(&rule);
    }
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      given.values.push_back(load_.along_normals ? Vec3(block(ConstReals(sums), static_cast<std::int32_t>(i)))
                                                 : Vec3(Vec3::Constant(sums[i])));
    }
    return given;
  }

  const LoadDescription& load_;
  const CutState& cut_;
  std::vector<Face> faces_;
  std::vector<char> is_changed_;  ///< nodes of faces that are not as they were, then and now
};

}  // namespace

void part_face_load(LoadDescription& load, const CutState& cut) {
  const std::map<std::int32_t, Vec3> left = FaceLoad(load, cut).find();
  RenewedLoad renewed(load);
  std::vector<char> is_first(at(cut.hosts.node_count()), 0);
  double largest = 0.0;
  for (const auto& [node, per_unit] : left) largest = std::max(largest, per_unit.norm());
  for (std::size_t i = 0; i < load.first_day.size(); ++i) {
    const std::int32_t node = load.first_day[i];
    is_first[at(node)] = 1;
    const auto found = left.find(node);
    if (found == left.end()) {
      renewed.add(node, block(ConstReals(load.first_forces), static_cast<std::int32_t>(i)));
    } else {
      renewed.add_left(node, found->second);
    }
  }
  for (const auto& [node, per_unit] : left) {
    if (is_first[at(node)] == 0 && per_unit.norm() > kNothing * largest) renewed.add_left(node, per_unit);
  }
}

}  // namespace tissu

#include "contact/fcl_broad_phase.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace tissu {
namespace {

/// An object whose box along the axes is given, and not computed from its shape and place.
class GivenBox : public fcl::CollisionObject<double> {
 public:
  GivenBox(const std::shared_ptr<fcl::CollisionGeometry<double>>& shape, std::int32_t primitive)
      : fcl::CollisionObject<double>(shape), primitive_(primitive) {}
  void take(const Box& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      aabb.min_[static_cast<Eigen::Index>(k)] = static_cast<double>(box.low[k]);
      aabb.max_[static_cast<Eigen::Index>(k)] = static_cast<double>(box.high[k]);
    }
  }
  [[nodiscard]] std::int32_t primitive() const { return primitive_; }

 private:
  std::int32_t primitive_;
};

struct Asked {
  const Meetings* meetings;
  std::span<const Box> boxes;
  FoundPairs* found;
};

/// Of each two objects that the library's tree brings together; false: it goes on.
bool take_pair(fcl::CollisionObject<double>* one, fcl::CollisionObject<double>* other, void* data) {
  const Asked& asked = *static_cast<Asked*>(data);
  const std::int32_t p = static_cast<const GivenBox*>(one)->primitive();
  const std::int32_t q = static_cast<const GivenBox*>(other)->primitive();
  if (asked.boxes[static_cast<std::size_t>(p)].overlaps(asked.boxes[static_cast<std::size_t>(q)]) &&
      asked.meetings->meet(p, q)) {
    asked.found->add(p, q);
  }
  return false;
}

}  // namespace

struct FclBroadPhase::Library {
  std::vector<std::unique_ptr<GivenBox>> objects;
  fcl::DynamicAABBTreeCollisionManager<double> manager;
  bool is_filled = false;
};

FclBroadPhase::FclBroadPhase(const SearchPlan& plan)
    : meetings_(plan), library_(std::make_unique<Library>()) {
  const auto shape = std::make_shared<fcl::Box<double>>(1.0, 1.0, 1.0);
  for (const std::int32_t p : meetings_.searched()) {
    library_->objects.push_back(std::make_unique<GivenBox>(shape, p));
  }
}

FclBroadPhase::~FclBroadPhase() = default;

void FclBroadPhase::find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) {
  meetings_.check(boxes);
  found_.clear();
  for (const std::unique_ptr<GivenBox>& object : library_->objects) {
    object->take(boxes[static_cast<std::size_t>(object->primitive())]);
  }
  if (!library_->objects.empty()) {
    if (!library_->is_filled) {
      std::vector<fcl::CollisionObject<double>*> all;
      for (const std::unique_ptr<GivenBox>& object : library_->objects) all.push_back(object.get());
      library_->manager.registerObjects(all);
      library_->manager.setup();
      library_->is_filled = true;
    } else {
      library_->manager.update();
    }
    Asked asked{&meetings_, boxes, &found_};
    library_->manager.collide(&asked, take_pair);
  }
  sort_.sort(found_.all(), meetings_.primitive_count(), pairs);
}

std::size_t FclBroadPhase::bytes() const {
  return meetings_.bytes() + library_->objects.size() * sizeof(GivenBox) + found_.bytes() + sort_.bytes();
}

}  // namespace tissu

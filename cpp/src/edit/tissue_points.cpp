#include "tissu/edit/tissue_points.h"

#include <string>
#include <utility>

#include "debris.h"
#include "described.h"
#include "tissu/base/error.h"
#include "tissu/edit/world_editor.h"

namespace tissu {
namespace {

/// The one block of points of a tissue; null of other bodies.
ElasticBlock* points_of(BodyDescription& body) {
  if (!body.frames || body.elastic.size() != 1) return nullptr;
  auto* options = std::get_if<FramesOptions>(&body.elastic.front().model);
  return options == nullptr || options->points == nullptr ? nullptr : &body.elastic.front();
}

}  // namespace

std::shared_ptr<const World> with_points(const World& world, std::string_view tissue, TissuePoints left,
                                         ConstReals places) {
  (void)described(world, tissue);  // refuses
  WorldDescription description = described_apart(world);
  BodyDescription& body = description.body(tissue);
  ElasticBlock* block = points_of(body);
  if (block == nullptr) {
    throw ParameterError("body \"" + body.name + "\" has no points without a mesh; name a tissue.");
  }
  if (places.size() != body.positions.size()) {
    throw ParameterError("found " + std::to_string(places.size()) + " coordinates of frames of tissue \"" +
                         body.name + "\"; " + std::to_string(body.positions.size()) + " are accepted.");
  }
  for (BodyDescription& other : description.bodies) number_cells(other);
  body.shared = std::move(left.shared);
  block->cells = std::move(left.points.frames);
  auto& options = std::get<FramesOptions>(block->model);
  options.points = std::make_shared<const FramePoints>(std::move(left.points));
  State now;
  now.positions.assign(places.begin(), places.end());
  hold_debris(description, body, now, 0);
  std::erase_if(description.fixed, [](const FixedNodes& fixed) { return fixed.nodes.empty(); });
  return std::make_shared<World>(std::move(description), &world, true);
}

}  // namespace tissu

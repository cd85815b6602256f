#pragma once

/// One cell of frames, its nodes and rotations where they happen to be.

#include <string>
#include <vector>

#include "../../base/random.h"
#include "../../cell/reference_nodes.h"
#include "tissu/element/reference_cell.h"
#include "tissu/model/frames/frames.h"

namespace tissu::test {

struct FramesCase {
  std::string element;
  std::string law;
  std::string quadrature = "full";
  std::string section = "whole";
  std::string lever = {};
};

/// Nodes 0 to n - 1 are origins, n to 2 n - 1 their rotations.
class FramesSample {
 public:
  explicit FramesSample(const FramesCase& c, std::string tangent = "full") {
    Random random(11);
    block_.body = "body";
    block_.element = c.element;
    block_.quadrature = c.quadrature;
    block_.law = c.law;
    for (const LawParameter& p : find_law(c.law)->parameters)
      block_.parameters[std::string(p.name)] = {p.typical};
    block_.density = {1000.0};
    block_.cross_section = {0.2};
    block_.model = FramesOptions{.tangent = std::move(tangent), .section = c.section, .lever = c.lever};
    for (Vec3 x : reference_nodes(c.element)) {
      x += random.vector(0.04);
      rest_.insert(rest_.end(), x.begin(), x.end());
    }
    count_ = static_cast<std::int32_t>(rest_.size() / 3);
    for (std::int32_t a = 0; a < count_; ++a) {
      block_.cells.push_back(a);
      block_.frames.push_back(a);
      frames_.push_back({a, count_ + a, 1.0, Mat3::Identity()});
    }
    block_.first_rotation = count_;
    rest_.resize(2 * rest_.size(), 0.0);
  }
  [[nodiscard]] const ElasticBlock& block() const { return block_; }
  [[nodiscard]] const std::vector<double>& rest() const { return rest_; }
  [[nodiscard]] std::int32_t count() const { return count_; }
  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  [[nodiscard]] Frames model(int threads = 1) const {
    return {block_, rest_, choose_isa(), Threads(threads)};
  }

  [[nodiscard]] State rest_state() const {
    State state;
    state.positions = rest_;
    state.velocities.assign(rest_.size(), 0.0);
    state.rotations.assign(static_cast<std::size_t>(count_), Quaternion::Identity());
    return state;
  }
  /// Moved and turned by up to about `far`.
  [[nodiscard]] State disturbed(double far, unsigned seed = 5) const {
    Random random(seed);
    const State rest = rest_state();
    State state = rest;
    move(rest, frames_, random.numbers(rest_.size(), far), 1.0, state);
    return state;
  }
  /// All of it turned by q about the origin, and moved by d.
  [[nodiscard]] State carried(const State& from, const Quaternion& q, const Vec3& d) const {
    State state = from;
    for (std::int32_t a = 0; a < count_; ++a) {
      tissu::block(Reals(state.positions), a) = q * Vec3(tissu::block(ConstReals(from.positions), a)) + d;
      state.rotations[static_cast<std::size_t>(a)] = q * from.rotations[static_cast<std::size_t>(a)];
    }
    return state;
  }

 private:
  ElasticBlock block_;
  std::vector<double> rest_;
  std::int32_t count_ = 0;
  std::vector<Frame> frames_;
};

}  // namespace tissu::test

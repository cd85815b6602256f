#pragma once

/// What is led cannot be held back, so it goes first and pushes what is in its way.

#include <vector>

#include "hold_back.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact.h"

namespace tissu {

/// Where obstacles and given rows go in a step.
struct LedMotion {
  const State& state;                  ///< of the step's start, whose memory holds live leads
  double from;                         ///< [s]
  double to;                           ///< [s]
  ConstReals end;                      ///< positions of the rows at the end; only given rows are read
  std::span<const Quaternion> turned;  ///< of all frames: given ones at the end, others at the start
};

/// Leads all given vertices to their places at the end of the step, in equal parts of at most half a mean
/// edge. Vertices that a led one would come too near go along with it as if glued; their ways are tested too.
/// Where a part cannot be gone that way the parts are made shorter.
class PushAhead {
 public:
  /// `given`: of each mover, and of vertices that rows carry, whether its place is.
  PushAhead(const Contact& contact, const std::vector<std::uint8_t>& given);

  /// `places` of all movers at the start become those from which the step goes on; `planes` those at its
  /// end. Throws Diverged where things that are led close on a body.
  void push(const LedMotion& motion, Candidates& candidates, std::vector<double>& places,
            std::vector<PlacedPlane>& planes);
  /// How far obstacles are led, over the longest way of a part.
  [[nodiscard]] double parts_of(const LedMotion& motion) const;

 private:
  void lead(const LedMotion& motion, double share, Reals places) const;
  void place_riders(const LedMotion& motion, double share, Reals places) const;
  void place_planes(const LedMotion& motion, double share, std::vector<PlacedPlane>& planes) const;
  /// One part; false: something is still in the way.
  bool go(const LedMotion& motion, double before, double after, Candidates& candidates,
          std::vector<double>& places);
  void move(std::int32_t vertex, const Vec3& by);
  void move_row(std::int32_t mover, const Vec3& by);
  bool push_pairs(const Candidates& candidates, ConstReals from, bool& pushed);
  bool push_before_planes(const LedMotion& motion, double before, double after, const Candidates& candidates,
                          ConstReals from, bool& pushed);
  [[noreturn]] void refuse(const LedMotion& motion, double way) const;

  const Contact& contact_;
  const std::vector<std::uint8_t>& given_;
  double part_ = 0.0;  ///< longest way of a part [m]
  std::vector<double> to_;
  std::vector<double> begin_;
  std::vector<PlacedPlane> last_;  ///< planes at the end of the step
  std::int32_t culprit_ = -1;      ///< a vertex of the latest pair that stayed in the way
  std::int32_t other_ = -1;
};

}  // namespace tissu

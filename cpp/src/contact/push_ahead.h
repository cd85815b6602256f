#pragma once

/// What is led cannot be held back, so it goes first and pushes what is in its way.

#include <array>
#include <cstdint>
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
  /// end. Throws Diverged where things that are led close on a body, and where a surface with a radius goes
  /// into what is held.
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
  // into_held.cpp
  /// Whether obstacles that are led, if they are, may meet what is given of bodies.
  [[nodiscard]] bool find_held() const;
  /// Measures how near an obstacle and what is given of a body are before and after a part.
  void measure_room(const Candidate& candidate, ConstReals from);
  void measure_room(std::int32_t pair, double before, double after, const std::array<std::int32_t, 2>& ends);
  /// The thickness of an obstacle, or of a body before one, is led further into what is given: nothing can
  /// give way there, and the test of ways knows the middle of thick things only.
  [[nodiscard]] bool is_led_into_held();
  [[noreturn]] void refuse(const LedMotion& motion, double way) const;

  const Contact& contact_;
  const std::vector<std::uint8_t>& given_;
  double part_ = 0.0;  ///< longest way of a part [m]
  bool meets_held_ = false;
  bool is_led_in_ = false;  ///< the latest part led a thickness into what is given
  struct Room {
    double before;                      ///< the least distance beside thicknesses [m]
    double after;                       ///< the same at the end of the part
    std::array<std::int32_t, 2> where;  ///< vertices of both sides; -1: a plane
  };
  std::vector<Room> rooms_;  ///< of each pair of the description; empty: nothing held is met
  std::vector<double> to_;
  std::vector<double> begin_;
  std::vector<PlacedPlane> last_;  ///< planes at the end of the step
  std::int32_t culprit_ = -1;      ///< a vertex of the latest pair that stayed in the way
  std::int32_t other_ = -1;
};

}  // namespace tissu

#pragma once

/// What each shape function is to the list of them: a way from a point to a row of weights.

#include <memory>
#include <string>
#include <vector>

#include "nearest.h"
#include "tissu/field/shape_function.h"

namespace tissu {

/// The row of one point, in any order.
struct ShapeRow {
  std::vector<std::int32_t> frames;
  std::vector<double> weights;
  std::vector<Vec3> gradients;  ///< [1/m]
  void resize(int neighbours);
};

/// One shape function of one list of frames. Has scratch: one thread at a time.
class ShapeFunction {
 public:
  ShapeFunction() = default;
  ShapeFunction(const ShapeFunction&) = delete;
  ShapeFunction& operator=(const ShapeFunction&) = delete;
  ShapeFunction(ShapeFunction&&) = delete;
  ShapeFunction& operator=(ShapeFunction&&) = delete;
  virtual ~ShapeFunction() = default;
  [[nodiscard]] virtual int neighbours() const = 0;
  /// Fills a row that has the right size. What is wrong with the point, and what to do, in words that go on
  /// after "point 3 at (...) m"; empty when nothing is.
  [[nodiscard]] virtual std::string fill(const Vec3& x, ShapeRow& row) = 0;
};

/// Frames that are known to be finite and distinct, and what is asked of them.
struct ShapeRequest {
  const ShapeFunctionInfo& info;
  const ShapeFunctionUse& use;
  ConstReals frames;
  const Nearest& nearest;
  std::string where;  ///< how messages begin
};

/// The k nearest frames of a point.
class Neighbourhood {
 public:
  /// Throws ParameterError when there are fewer frames than neighbours.
  explicit Neighbourhood(const ShapeRequest& request);
  [[nodiscard]] int neighbours() const { return neighbours_; }
  /// Finds them and writes their numbers to the row, nearest first.
  void move_to(const Vec3& x, ShapeRow& row);
  [[nodiscard]] const Eigen::Matrix3Xd& offsets() const { return offsets_; }  ///< x - x_i [m]
  [[nodiscard]] const Eigen::VectorXd& distances() const { return distances_; }

 private:
  ConstReals frames_;
  const Nearest& nearest_;
  int neighbours_;
  std::vector<Nearest::Found> found_;
  Eigen::Matrix3Xd offsets_;
  Eigen::VectorXd distances_;
};

std::unique_ptr<ShapeFunction> make_shepard(const ShapeRequest& request);
std::unique_ptr<ShapeFunction> make_wendland(const ShapeRequest& request);
std::unique_ptr<ShapeFunction> make_cubic_spline(const ShapeRequest& request);
std::unique_ptr<ShapeFunction> make_linear(const ShapeRequest& request);
std::unique_ptr<ShapeFunction> make_trilinear(const ShapeRequest& request);
std::unique_ptr<ShapeFunction> make_moving_least_squares(const ShapeRequest& request);

/// A function whose number of neighbours follows from the frames takes 0, its own number and what follows.
void check_implied_neighbours(const ShapeRequest& request, int implied, std::string_view because);

/// That the nearest frame, at a distance [m], is outside of the support.
std::string unreached(double distance, double radius);

/// A length in metres, for messages.
std::string metres(double value);

}  // namespace tissu

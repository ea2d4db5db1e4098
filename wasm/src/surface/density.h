// The grid lines of a face: how many, and where.
//
// Source: Kumar, sec. 2: a grid of lines of equal u and of equal v.
// Differs: lines halve the intervals between creases again and again, so that one more line moves no other. Their density
// follows the surface's normal curvature: an interval of width h across which a surface has the second fundamental form L is
// off its chord by h² L / 8. The form is looked at once for each face; all later choices are made from its largest values.
#pragma once
#include <cstdint>
#include <vector>

#include "base/point2.h"
#include "surface/allowance.h"
#include "surface/nurbs_surface.h"
#include "surface/sampling.h"

namespace sf {

/// The intervals of one parameter.
class LineTree {
 public:
  /// What a surface is like between two values of the parameter, at its worst along the other.
  struct Column {
    double from, to;
    double form;   // second fundamental form along the parameter
    double turn;   // of the normal, radians for each unit of the parameter
    double twist;  // mixed part of the form
    double speed;  // length in space for each unit of the parameter, in the mean
  };

  LineTree() = default;
  /// For columns in order, between `breaks`, the first and last of which are the ends.
  LineTree(std::vector<Column> columns, std::vector<double> breaks);

  /// Halves intervals until their errors and turns are at most these.
  ///   allowed  the most error of an interval from a to b
  struct Choice {
    std::vector<uint32_t> nodes;  // the intervals, in order
    double error = 0;             // the largest, as a share of what is allowed
  };
  template <class F>
  void choose(double share, F&& allowed, double turn, Choice& choice);
  /// Halves those that are longer than this.
  void shorten(double longest, Choice& choice);
  /// Halves intervals of a choice, where `halved` says so.
  void halve(const std::vector<uint8_t>& halved, Choice& choice);
  /// [nodes + 1] where the lines are.
  void lines(const Choice& choice, std::vector<double>& at) const;

  double length(uint32_t node) const { return nodes_[node].length; }
  double error(uint32_t node) const { return nodes_[node].error; }
  double twist(uint32_t node) const { return nodes_[node].twist; }
  bool isFlat() const { return isFlat_; }
  /// The breaks between the ends.
  const std::vector<double>& creases() const { return creases_; }

 private:
  struct Node {
    double a, b;
    double error, turn, twist, length;  // twist: the form's mixed part times the width
    uint32_t child = kNone;
  };
  uint32_t add(double a, double b);
  uint32_t childOf(uint32_t node);
  template <class F>
  void refine(F&& isHalved, Choice& choice);

  std::vector<Column> columns_;
  std::vector<double> creases_;
  std::vector<uint32_t> open_;  // of one call
  std::vector<Node> nodes_;
  uint32_t roots_ = 0;
  bool isFlat_ = true;
};

/// The breaks of a surface where its tangents turn at once, all along or in part.
std::vector<double> creasesOf(const NurbsSurface& surface, bool alongU);

/// The lines of a face.
class Density {
 public:
  Density() = default;
  /// Looks at the surface within a box of its domain. O(patches p q) evaluations.
  Density(const NurbsSurface& surface, Box2 box);

  /// Chooses lines.
  struct Lines {
    LineTree::Choice u, v;
  };
  void choose(const Allowance& allowance, const Fineness& fineness, Lines& lines);
  /// What is allowed where, for a picture.
  Allowance allowanceOf(const NurbsSurface& surface, const Fineness& fineness);

  /// How long an edge's intervals may be beside such cells: as some of the longer sides of a usual cell. Infinite where there is
  /// one cell.
  double longest(const Lines& lines) const;

  /// How much shorter a domain is to be taken along u, x, and along v, y, so that cells far longer than wide do not seem so:
  /// triangles beside them are then as long.
  Point2 shortening(const Lines& lines) const;

  LineTree u, v;
  /// Whether the surface is a plane within the box.
  bool isFlat() const { return u.isFlat() && v.isFlat() && twist_ == 0; }
  /// How far a chord between two points of the domain may be off the surface, nearly.
  double bound(Point2 a, Point2 b) const {
    const double du = std::fabs(b.x - a.x), dv = std::fabs(b.y - a.y);
    return (du * du * formU_ + 2 * du * dv * twist_ + dv * dv * formV_) / 8;
  }
  /// Whether two points are so far apart, for the surface's spans, that it may bend to and fro between them.
  bool isFar(double du, double dv) const { return std::fabs(du) > farU_ || std::fabs(dv) > farV_; }
  /// The box of the places looked at.
  Vec3 least{}, greatest{};
  /// Mean length in space of a unit of u, and of v.
  double speedU() const { return speedU_; }
  double speedV() const { return speedV_; }

 private:
  void look(const NurbsSurface& surface, Box2 box, std::vector<LineTree::Column>& columnsU,
            std::vector<LineTree::Column>& columnsV);

  /// A ball around a part of the surface.
  struct Ball {
    Vec3 middle;
    double radius;
  };
  /// One of the smallest parts, nearly: what lies between its corners, and how far the surface is off that.
  struct Net {
    Vec3 corners[4];  // u by u
    double off;

    Vec3 at(double x, double y) const {
      const Vec3 a = corners[0] + y * (corners[1] - corners[0]),
                 b = corners[2] + y * (corners[3] - corners[2]);
      return a + x * (b - a);
    }
  };

  void chooseAny(const Allowance& allowance, double turn, Lines& lines);
  void shapeCells(double aspect, Lines& lines);
  void findBalls(const NurbsSurface& surface);
  static double finestOf(const Fineness& fineness, const Net& net, int levels);
  void fillParts(const Fineness& fineness, uint32_t level, uint32_t i, uint32_t j,
                 std::vector<double>& parts) const;

  Box2 box_{};
  std::vector<Ball> balls_;  // once they were wanted: of all of it, of its 4 quarters, their 16 ...
  std::vector<Net> nets_;    // of the smallest parts
  double farU_ = 0, farV_ = 0;
  double twist_ = 0, formU_ = 0, formV_ = 0, speedU_ = 1, speedV_ = 1;
};

}  // namespace sf

// Fuzzes sf_find_holes, sf_fill_holes, sf_carry_on and sf_smooth_surface through the C ABI: grids with faces left out, doubled and
// turned, vertices moved onto each other, and what is no mesh at all.
// Whatever comes back has to be a status, or a mesh with the right numbers of everything and finite coordinates.
#include <cmath>
#include <vector>

#include "fuzz/bytes.h"
#include "soapfilm.h"

using namespace sffuzz;

namespace {

/// Calls of the progress function, each after a million units of work, until an input ends.
constexpr uint32_t kMostCalls = 60;
uint32_t callsLeft;

struct Mesh {
  std::vector<double> positions;
  std::vector<uint32_t> faces;
  uint32_t vertexCount() const { return uint32_t(positions.size() / 3); }
  uint32_t faceCount() const { return uint32_t(faces.size() / 3); }
};

/// A sheet, a tube or a torus of squares, or a closed box of few faces, by their ways round.
Mesh grid(Bytes& in) {
  const uint32_t rows = 3 + in.below(6), columns = 3 + in.below(6), ways = in.below(3);
  const bool closesRows = ways > 1, closesColumns = ways > 0;
  const double kTurn = 6.283185307179586;
  Mesh mesh;
  for (uint32_t r = 0; r < rows; ++r)
    for (uint32_t c = 0; c < columns; ++c) {
      const double u = kTurn * r / rows, v = kTurn * c / columns, tube = 2 + std::cos(u);
      if (ways == 0)
        mesh.positions.insert(mesh.positions.end(), {double(r), double(c), 0.1 * in.below(8)});
      else if (ways == 1)
        mesh.positions.insert(mesh.positions.end(), {std::cos(v), std::sin(v), double(r)});
      else
        mesh.positions.insert(mesh.positions.end(),
                              {tube * std::cos(v), tube * std::sin(v), std::sin(u)});
    }
  for (uint32_t r = 0; r + !closesRows < rows; ++r)
    for (uint32_t c = 0; c + !closesColumns < columns; ++c) {
      const uint32_t s = (r + 1) % rows, d = (c + 1) % columns;
      const uint32_t a = r * columns + c, b = s * columns + c, e = s * columns + d,
                     f = r * columns + d;
      mesh.faces.insert(mesh.faces.end(), {a, b, e, a, e, f});
    }
  return mesh;
}

/// Some faces go, come twice or are turned; some vertices move, at times onto others or out of all bounds.
void spoil(Mesh& mesh, Bytes& in) {
  for (uint32_t edits = in.below(24); edits > 0 && mesh.faceCount() > 0; --edits) {
    const uint32_t f = (in.byte() | uint32_t(in.byte()) << 8) % mesh.faceCount();
    const auto at = mesh.faces.begin() + 3 * f;
    const uint32_t v = *at, w = at[1];
    switch (in.below(8)) {
      case 0: {
        const uint32_t copy[] = {at[0], at[1], at[2]};
        mesh.faces.insert(mesh.faces.end(), copy, copy + 3);
        break;
      }
      case 1:
        std::swap(at[1], at[2]);
        break;
      case 2:
        at[1] = at[2];
        break;
      case 3:
        for (int k = 0; k < 3; ++k) mesh.positions[3 * v + k] = mesh.positions[3 * w + k];
        break;
      case 4:
        mesh.positions[3 * v + in.below(3)] += (in.below(64) - 32) / 16.0;
        break;
      case 5:
        if (in.below(16) == 15) mesh.positions[3 * v] = in.raw();
        if (in.below(16) == 15) *at = in.byte();
        break;
      default:
        mesh.faces.erase(at, at + 3);
    }
  }
}

template <class T>
const T* array(const SfResult* result, uint32_t index, size_t& length) {
  length = sf_result_length(result, index);
  return static_cast<const T*>(sf_result_data(result, index));
}

void requireFinite(const double* numbers, size_t count) {
  for (size_t i = 0; i < count; ++i) require(std::isfinite(numbers[i]), "finite coordinates");
}

void fill(const Mesh& mesh, const SfResult* holes, Bytes& in) {
  size_t groups, loops;
  const uint32_t* starts = array<uint32_t>(holes, SfHoles_groupStarts, groups);
  const uint32_t* numbers = array<uint32_t>(holes, SfHoles_groupLoops, loops);
  require(groups > 0, "where groups begin");
  size_t sessions;
  const uint32_t* kept = array<uint32_t>(holes, SfHoles_session, sessions);
  require(sessions == 1, "a session");
  const uint32_t session = *kept;
  std::vector<SfPatchSettings> settings(groups - 1);
  for (SfPatchSettings& s : settings) {
    s.areaWeight = in.below(2) ? NAN : in.below(3);
    s.perimeterWeight = in.below(2);
    s.dihedralWeight = 1;
    s.space = in.below(4);
    s.fairing = in.below(4);
    s.density = in.below(4) * 0.7;
    s.maxNewVertices = 4.0 * in.byte();
    s.crease = in.below(3) * 0.5;
    s.inFloats = in.below(2);
    s.maxSeconds = in.below(4) ? INFINITY : in.below(8);
  }
  SfPlace where;
  SfResult* result = nullptr;
  const SfStatus status = sf_fill_holes(session, starts, uint32_t(groups - 1), numbers,
                                        settings.data(), 64e6, &where, &result);
  require((status == 0) == (result != nullptr), "a result with Ok alone");
  if (result == nullptr) return;
  size_t coordinates, corners, facts, pairs;
  const double* positions = array<double>(result, SfFill_positions, coordinates);
  const uint32_t* faces = array<uint32_t>(result, SfFill_faces, corners);
  array<double>(result, SfFill_holes, facts);
  const uint32_t* pair = array<uint32_t>(result, SfFill_pairs, pairs);
  require(facts == (groups - 1) * sizeof(SfFilledFacts) / sizeof(double), "facts of every hole");
  const size_t vertexCount = mesh.vertexCount() + coordinates / 3,
               faceCount = mesh.faceCount() + corners / 3;
  for (size_t i = 0; i < corners; ++i)
    require(faces[i] < vertexCount, "faces of vertices that there are");
  for (size_t i = 0; i < pairs; ++i) require(pair[i] < faceCount, "pairs of faces that there are");
  requireFinite(positions, coordinates);
  size_t places, parameters;
  const uint32_t* split = array<uint32_t>(result, SfFill_splits, places);
  const double* parameter = array<double>(result, SfFill_splitParameters, parameters);
  require(places == 3 * parameters, "a place for every split");
  for (size_t i = 0; i < parameters; ++i) {
    require(split[3 * i] < mesh.faceCount(), "splits of faces that there are");
    require(parameter[i] > 0 && parameter[i] < 1, "splits within edges");
    const uint32_t* f = &mesh.faces[3 * size_t(split[3 * i])];
    for (int k = 1; k < 3; ++k) {
      const uint32_t v = split[3 * i + k];
      require(v == f[0] || v == f[1] || v == f[2], "splits of the face's edges");
    }
  }
  sf_result_free(result);
}

void smooth(const Mesh& mesh, Bytes& in) {
  const SfSmoothSettings settings{double(in.below(3)), in.below(4) * 0.7, 2.0 * in.byte(), 64e6};
  std::vector<uint32_t> fixed;
  for (uint32_t i = in.below(4); i > 0; --i) fixed.push_back(in.below(mesh.vertexCount() + 1));
  std::vector<double> normals;
  for (uint32_t i = 3 * in.below(40); i > 0; --i)
    normals.push_back(in.below(9) == 0 ? std::nan("") : in.below(5) - 2.0);
  SfPlace where;
  SfResult* result = nullptr;
  sf_smooth_surface(mesh.positions.data(), mesh.vertexCount(), mesh.faces.data(), mesh.faceCount(),
                    fixed.data(), uint32_t(fixed.size()),
                    normals.empty() ? nullptr : normals.data(), uint32_t(normals.size() / 3),
                    &settings, &where, &result);
  if (result == nullptr) return;
  size_t coordinates;
  const double* positions = array<double>(result, SfSmooth_positions, coordinates);
  requireFinite(positions, coordinates);
  sf_result_free(result);
}

void carryOn(const Mesh& mesh, Bytes& in) {
  const uint32_t fixedCount = in.below(mesh.vertexCount() + 2), size = in.below(6);
  std::vector<double> values(size_t(fixedCount) * size);
  for (double& x : values) x = in.below(40) == 39 ? in.raw() : in.byte();
  SfPlace where;
  SfResult* result = nullptr;
  const SfStatus status =
      sf_carry_on(mesh.positions.data(), mesh.vertexCount(), mesh.faces.data(), mesh.faceCount(),
                  fixedCount, values.data(), size, 64e6, &where, &result);
  require((status == 0) == (result != nullptr), "a result with Ok alone");
  if (result == nullptr) return;
  size_t count;
  array<double>(result, SfCarry_values, count);
  require(count == size_t(size) * (mesh.vertexCount() - fixedCount), "values of every vertex");
  sf_result_free(result);
}

}  // namespace

extern "C" int32_t sf_host_progress(double fraction, double, double) {
  require(fraction >= 0 && fraction <= 1, "a fraction of the work");
  return callsLeft > 0 && callsLeft-- > 0;
}

extern "C" double sf_host_seconds() { return kMostCalls - callsLeft; }

extern "C" void sf_host_result(const SfResult*) {}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  callsLeft = kMostCalls;
  Mesh mesh = grid(in);
  spoil(mesh, in);
  const uint32_t task = in.below(8);
  if (task == 0) carryOn(mesh, in);
  if (task == 1 || task == 2) smooth(mesh, in);
  if (task < 3) return 0;
  SfPlace where;
  SfResult* holes = nullptr;
  const SfStatus status =
      sf_find_holes(mesh.positions.data(), mesh.vertexCount(), mesh.faces.data(), mesh.faceCount(),
                    1, 1, 64e6, &where, &holes);
  require((status == 0) == (holes != nullptr), "a result with Ok alone");
  if (holes == nullptr) return 0;
  fill(mesh, holes, in);
  size_t length;
  sf_close_mesh(*array<uint32_t>(holes, SfHoles_session, length));
  sf_result_free(holes);
  return 0;
}

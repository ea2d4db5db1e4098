// sf_find_holes, sf_fill_holes, sf_close_mesh, sf_weld_mesh, sf_find_crossings: refuse input that has no meaning to the core, call it,
// pack the results.
#include "abi/host_work.h"
#include "abi/kept.h"
#include "abi/mesh_input.h"
#include "abi/result.h"
#include "mesh/fill.h"
#include "mesh/weld.h"

namespace {

SF_TIE(isTied, sf::GroupKind, SF_GROUP_KIND_CHOICES)
SF_TIE(isTied, sf::DefectKind, SF_DEFECT_KIND_CHOICES)
SF_TIE(isTied, sf::Fairing, SF_FAIRING_CHOICES)
SF_TIE(isTied, sf::FillStatus, SF_FILL_STATUS_CHOICES)
SF_TIE(isTied, sf::FillReason, SF_FILL_REASON_CHOICES)

/// A mesh and its rims.
struct Found {
  sf::MeshView mesh;
  sf::Adjacency adjacency;
  sf::Rims rims;
};

/// A mesh that is kept for filling.
struct OpenMesh {
  std::vector<double> positions;
  std::vector<uint32_t> faces;
  Found found;
  sf::Surroundings around;
  bool isSurveyed = false;
  uint64_t bytes = 0;  // of all that
};

sf::Kept<OpenMesh>& openMeshes() {
  static sf::Kept<OpenMesh> all;
  return all;
}

bool find(sf::Work& work, sf::Charge& charge, Found& found) {
  work.phase(0, 0.4);
  if (!sf::buildAdjacency(found.mesh, work, charge, found.adjacency)) return false;
  work.phase(0.4, 0.6);
  return sf::findRims(found.mesh, found.adjacency, work, charge, found.rims);
}

SfResult* pack(const Found& found, sf::Grouping&& grouping) {
  std::vector<SfLoopFacts> loops;
  for (uint32_t i = 0; i < found.rims.count(); ++i) {
    const sf::Rim& rim = found.rims.rims[i];
    loops.push_back({rim.length, rim.diameter, grouping.openness[i], double(rim.component),
                     double(rim.isSeam)});
  }
  std::vector<SfGroupFacts> groups;
  for (uint32_t g = 0; g < grouping.count(); ++g)
    groups.push_back(
        {double(grouping.kinds[g]), grouping.scores[g], double(grouping.isOpenRim[g])});
  std::vector<SfDefectCounts> defects;
  std::vector<uint32_t> places;
  for (const sf::Defect& defect : found.adjacency.defects) {
    defects.push_back({uint32_t(defect.kind), uint32_t(defect.faces.size()),
                       uint32_t(defect.edges.size()), uint32_t(defect.vertices.size())});
    for (const auto* list : {&defect.faces, &defect.edges, &defect.vertices})
      places.insert(places.end(), list->begin(), list->end());
  }
  auto* result = new SfResult(SfHolesArrayCount);
  result->put<SfHoles_loopStarts>(std::vector<uint32_t>(found.rims.starts));
  result->put<SfHoles_loopVertices>(std::vector<uint32_t>(found.rims.vertices));
  result->put<SfHoles_loopFacts>(std::move(loops));
  result->put<SfHoles_groupStarts>(std::move(grouping.starts));
  result->put<SfHoles_groupLoops>(std::move(grouping.rims));
  result->put<SfHoles_groupFacts>(std::move(groups));
  result->put<SfHoles_defects>(std::move(defects));
  result->put<SfHoles_defectPlaces>(std::move(places));
  return result;
}

bool isValid(const SfPatchSettings& s) {
  const int kGiven = int(sf::Space::Given);
  return !(s.areaWeight < 0) && s.perimeterWeight >= 0 && s.dihedralWeight >= 0 &&
         sf::isChoice(s.space, kGiven) && sf::isChoice(s.fairing, SF_COUNT(SF_FAIRING_CHOICES)) &&
         s.density >= 0 && s.density < 1e6 && s.maxNewVertices >= 0 && s.crease >= 0 &&
         s.crease < 4 && sf::isChoice(s.inFloats, 2) && s.maxSeconds >= 0;
}

sf::FillOptions optionsOf(const SfPatchSettings& s) {
  sf::FillOptions options;
  options.areaWeight = s.areaWeight;
  options.perimeterWeight = s.perimeterWeight;
  options.dihedralWeight = s.dihedralWeight;
  options.space = sf::Space(int(s.space));
  options.fairing = sf::Fairing(int(s.fairing));
  options.refining.density = s.density;
  options.crease = s.crease;
  options.inFloats = s.inFloats == 1;
  options.refining.maxNewVertices = sf::vertexLimit(s.maxNewVertices);
  options.maxSeconds = s.maxSeconds;
  if (std::isfinite(s.maxSeconds)) options.clock = sf_host_seconds;
  return options;
}

/// Whether each group has loops, and no loop is named twice.
bool areGroups(const uint32_t* starts, uint32_t count, const uint32_t* loops, uint32_t loopCount) {
  if (!sf::isRising(starts, count)) return false;
  std::vector<uint8_t> isNamed(loopCount);
  for (uint32_t g = 0; g < count; ++g)
    if (starts[g] == starts[g + 1]) return false;
  for (uint32_t i = 0; i < starts[count]; ++i) {
    if (loops[i] >= loopCount || isNamed[loops[i]]) return false;
    isNamed[loops[i]] = 1;
  }
  return true;
}

SfFilledFacts factsOf(const sf::FilledHole& hole) {
  SfFilledFacts facts{};
  facts.status = double(hole.status);
  facts.reason = double(hole.reason);
  facts.cost = hole.cost;
  facts.lowerBound = hole.lowerBound;
  facts.optimal = hole.optimal;
  facts.rimAngleBefore = hole.rimAngleBefore;
  facts.rimAngleAfter = hole.rimAngleAfter;
  facts.fairnessUsed = hole.fairnessUsed;
  facts.movedLess = hole.movedLess;
  facts.firstFace = hole.firstFace;
  facts.endFace = hole.endFace;
  facts.pairs = double(hole.intersections.size());
  facts.splits = double(hole.splits.size());
  return facts;
}

}  // namespace

extern "C" SfStatus sf_find_holes(const double* positions, uint32_t vertexCount,
                                  const uint32_t* faces, uint32_t faceCount, uint32_t keeps,
                                  uint32_t groups, double maxBytes, SfPlace* where,
                                  SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0)) return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::Charge charge(work);
  auto opened = std::make_unique<OpenMesh>();
  sf::MeshView& mesh = opened->found.mesh;
  sf::Outcome outcome = sf::viewMesh(positions, vertexCount, faces, faceCount, mesh);
  if (outcome.ok() && keeps) {
    if (sf::reserve(opened->positions, mesh.positions.size(), charge) &&
        sf::reserve(opened->faces, mesh.faces.size(), charge)) {
      opened->positions.assign(mesh.positions.begin(), mesh.positions.end());
      opened->faces.assign(mesh.faces.begin(), mesh.faces.end());
      mesh = {opened->positions, opened->faces};
    } else {
      outcome = {work.status()};
    }
  }
  sf::Grouping grouping;
  Found& found = opened->found;
  if (outcome.ok() && !find(work, charge, found)) outcome = {work.status()};
  // The grouping is handed out, and not kept.
  opened->bytes = charge.bytes();
  work.beginStage(0.6, 1);
  if (outcome.ok() && groups &&
      !sf::groupRims(mesh, found.adjacency, found.rims, work, charge, grouping))
    outcome = {work.status()};
  if (outcome.ok()) {
    *result = groups ? pack(found, std::move(grouping)) : new SfResult(SfHolesArrayCount);
    if (keeps)
      (*result)->put<SfHoles_session>(std::vector<uint32_t>{openMeshes().keep(std::move(opened))});
  }
  return sf::endWith(outcome, where);
}

extern "C" SfStatus sf_fill_holes(uint32_t session, const uint32_t* groupStarts,
                                  uint32_t groupCount, const uint32_t* groupLoops,
                                  const SfPatchSettings* settings, double maxBytes, SfPlace* where,
                                  SfResult** result) {
  *result = nullptr;
  OpenMesh* opened = openMeshes().find(session);
  bool isAllowed = opened && maxBytes >= 0;
  for (uint32_t g = 0; isAllowed && g < groupCount; ++g) isAllowed = isValid(settings[g]);
  if (!isAllowed || !areGroups(groupStarts, groupCount, groupLoops, opened->found.rims.count()))
    return sf::endWith({sf::Status::BadOption}, where);
  const auto& [mesh, adjacency, rims] = opened->found;
  sf::Work work = sf::hostWork(maxBytes);
  sf::Charge held(work);
  if (!held.add(opened->bytes)) return sf::endWith({work.status()}, where);
  if (groupCount > 0 && !opened->isSurveyed) {
    if (!sf::survey(mesh, adjacency, rims, work, held, opened->around)) {
      opened->around = {};
      return sf::endWith({work.status()}, where);
    }
    opened->isSurveyed = true;
    opened->bytes = held.bytes();
  }
  sf::HoleFiller filler(mesh, adjacency, rims, opened->around, work);
  sf::Outcome outcome;
  std::vector<SfFilledFacts> facts;
  std::vector<uint32_t> pairs;
  std::vector<SfRimSplit> splits;
  std::vector<double> parameters;
  for (uint32_t g = 0; outcome.ok() && g < groupCount; ++g) {
    work.beginStage(double(g) / groupCount, double(g + 1) / groupCount);
    sf::FilledHole hole;
    const uint32_t first = groupStarts[g];
    outcome.status = filler.fill({groupLoops + first, size_t(groupStarts[g + 1] - first)},
                                 optionsOf(settings[g]), hole);
    facts.push_back(factsOf(hole));
    for (const sf::FacePair pair : hole.intersections)
      pairs.insert(pairs.end(), {pair.first, pair.second});
    for (const sf::RimSplit& split : hole.splits) {
      splits.push_back({split.face, split.tail, split.head});
      parameters.push_back(split.parameter);
    }
  }
  if (outcome.ok()) {
    *result = new SfResult(SfFillArrayCount);
    (*result)->put<SfFill_positions>(filler.takePositions());
    (*result)->put<SfFill_faces>(filler.takeFaces());
    (*result)->put<SfFill_holes>(std::move(facts));
    (*result)->put<SfFill_pairs>(std::move(pairs));
    (*result)->put<SfFill_splits>(std::move(splits));
    (*result)->put<SfFill_splitParameters>(std::move(parameters));
  }
  return sf::endWith(outcome, where);
}

extern "C" SfStatus sf_close_mesh(uint32_t session) {
  openMeshes().drop(session);
  return SfStatus(sf::Status::Ok);
}

extern "C" SfStatus sf_find_crossings(const double* positions, uint32_t vertexCount,
                                      const uint32_t* faces, uint32_t faceCount, double maxBytes,
                                      SfPlace* where, SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0)) return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::MeshView mesh;
  sf::Outcome outcome = sf::viewMesh(positions, vertexCount, faces, faceCount, mesh);
  std::vector<sf::FacePair> found;
  const size_t most = 10000;
  if (outcome.ok() && !sf::findSelfIntersections(mesh, 0, faceCount, most, work, found))
    outcome = {work.status()};
  if (outcome.ok()) {
    std::vector<uint32_t> pairs;
    for (const sf::FacePair pair : found) pairs.insert(pairs.end(), {pair.first, pair.second});
    *result = new SfResult(SfCrossingsArrayCount);
    (*result)->put<SfCrossings_pairs>(std::move(pairs));
  }
  return sf::endWith(outcome, where);
}

extern "C" SfStatus sf_weld_mesh(const double* positions, uint32_t vertexCount,
                                 const uint32_t* faces, uint32_t faceCount, double radius,
                                 double maxBytes, SfPlace* where, SfResult** result) {
  *result = nullptr;
  if (!(maxBytes >= 0) || !(radius >= 0 && std::isfinite(radius)))
    return sf::endWith({sf::Status::BadOption}, where);
  sf::Work work = sf::hostWork(maxBytes);
  sf::Charge charge(work);
  sf::MeshView mesh;
  sf::Outcome outcome = sf::viewMesh(positions, vertexCount, faces, faceCount, mesh);
  sf::WeldedMesh welded;
  if (outcome.ok() && !sf::weldVertices(mesh, radius, work, charge, welded))
    outcome = {work.status()};
  if (outcome.ok()) {
    *result = new SfResult(SfWeldArrayCount);
    (*result)->put<SfWeld_positions>(std::move(welded.positions));
    (*result)->put<SfWeld_faces>(std::move(welded.faces));
    (*result)->put<SfWeld_vertexMap>(std::move(welded.vertexMap));
  }
  return sf::endWith(outcome, where);
}

#include "tests/benchmarks/exchange_study.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <ctime>
#include <map>
#include <set>

#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

constexpr double kPick_mm = 1, kDefinition_m = 0.002, kApart_mm = 12;
constexpr double kTurn_rad = 0.035, kSway_m = 0.005;  // 2 deg and 5 mm SD between two exposures

struct Picks {
  std::vector<LandmarkObservation> list;
  std::map<std::pair<int, std::string>, double> apart_mm;  ///< right from left, by view and landmark without side
};

void shortenLeft(ShapeParameters& shape, double shorter_m) {
  // Femur and tibia share it: about 0.43 and 0.40 m long.
  shape.sides[1].femur.elongation *= 1 - 0.5 * shorter_m / 0.43;
  shape.sides[1].tibia.elongation *= 1 - 0.5 * shorter_m / 0.40;
}

Picks drawPicks(const Skeleton& reference, const std::vector<ShapePrior>& priors, const std::vector<View>& views,
                const std::vector<std::string>& names, bool simultaneous, bool deformed, unsigned seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal;
  ShapeParameters shape = drawShape(priors, random);
  const Posture posture = drawStandingPosture(reference, random);
  if (deformed) shortenLeft(shape, 0.040);
  const Skeleton body = deformedSkeleton(reference, shape);
  const auto X_WB = segmentPoses(body, posture);
  Picks picks;
  std::map<std::string, std::vector<Eigen::Vector2d>> true_px;
  const double turn_rad = simultaneous ? 0 : kTurn_rad * normal(random);
  const Eigen::Vector3d sway_m = simultaneous
                                     ? Eigen::Vector3d{0, 0, 0}
                                     : Eigen::Vector3d{kSway_m * normal(random), 0, kSway_m * normal(random)};
  for (const auto& name : names) {
    const Landmark& landmark = body.landmark(name);
    Eigen::Vector3d p_W = X_WB[std::size_t(landmark.segment)] * landmark.p_BL;
    const std::string& bone = body.segments[std::size_t(landmark.segment)].name;
    if (deformed && name.ends_with("_l") && bone != "pelvis") p_W += Eigen::Vector3d{0, 0.0106, -0.0106};
    p_W += kDefinition_m * Eigen::Vector3d{normal(random), normal(random), normal(random)};
    for (int view = 0; view < int(views.size()); ++view) {
      if (view == 1) p_W = Eigen::AngleAxisd{turn_rad, Eigen::Vector3d::UnitY()} * p_W + sway_m;
      const double px_per_mm = pixelsPerMillimetre(views[std::size_t(view)], p_W);
      const Eigen::Vector2d uv_px = *project(views[std::size_t(view)], p_W);
      const Eigen::Vector2d noise{normal(random), normal(random)};
      picks.list.push_back({name, view, uv_px + kPick_mm * px_per_mm * noise, kPick_mm * px_per_mm});
      auto& both = true_px[std::to_string(view) + std::string{withoutSide(name)}];
      both.push_back(uv_px);
      if (both.size() == 2)
        picks.apart_mm[{view, std::string{withoutSide(name)}}] = (both[0] - both[1]).norm() / px_per_mm;
    }
  }
  return picks;
}

/// What is exchanged: landmarks without side, by view.
std::vector<SideExchange> exchangeOf(const std::string& kind, const Skeleton& skeleton, const Picks& picks,
                                     int view_count, unsigned seed) {
  std::mt19937_64 random{seed + 7000};
  std::map<std::string, std::vector<std::string>> of_bone;
  std::vector<std::string> all;
  for (const auto& pick : picks.list) {
    const std::string base{withoutSide(pick.landmark)};
    if (pick.view != 0 || !pick.landmark.ends_with("_r")) continue;
    const auto& bone = skeleton.segments[std::size_t(skeleton.landmark(pick.landmark).segment)].name;
    of_bone[std::string{withoutSide(bone)}].push_back(base);
    all.push_back(base);
  }
  const int view = int(random() % std::size_t(view_count));
  if (kind == "none") return {};
  if (kind == "landmark") return {{view, {all[random() % all.size()]}}};
  if (kind == "bone, one view" || kind == "bone, both views") {
    auto bone = of_bone.begin();
    std::advance(bone, long(random() % of_bone.size()));
    if (kind == "bone, one view") return {{view, bone->second}};
    return {{0, bone->second}, {1, bone->second}};
  }
  if (kind == "frontal view") return {{0, all}};
  if (kind == "lateral view") return {{1, all}};
  return {{0, all}, {1, all}};
}

std::set<std::pair<int, std::string>> setOf(const std::vector<SideExchange>& exchanges) {
  std::set<std::pair<int, std::string>> all;
  for (const auto& e : exchanges)
    for (const auto& landmark : e.landmarks) all.insert({e.view, landmark});
  return all;
}

double threadTime_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace

std::vector<ExchangeRow> studyExchange(const std::filesystem::path& resource_dir, const std::vector<View>& views,
                                       bool simultaneous, bool deformed, int bodies,
                                       const std::vector<std::string>& kinds) {
  const Skeleton skeleton = loadReferenceSkeleton(resource_dir);
  const auto priors = loadShapePriors(resource_dir);
  std::vector<std::string> names;
  for (const auto& landmark : loadLandmarkProtocol(resource_dir)) names.push_back(landmark.name);
  const std::vector<std::string> every{"none",         "landmark",     "bone, one view", "bone, both views",
                                       "frontal view", "lateral view", "both views"};
  std::vector<ExchangeRow> rows;
  for (const auto& kind : kinds.empty() ? every : kinds) {
    ExchangeRow row{std::string{simultaneous ? "slot scan" : "cone beam"} + (deformed ? ", deformed" : ""), kind};
    for (int n = 0; n < bodies; ++n) {
      Picks picks = drawPicks(skeleton, priors, views, names, simultaneous, deformed, unsigned(n + 1));
      const auto made = exchangeOf(kind, skeleton, picks, int(views.size()), unsigned(n + 1));
      bool apart = made.empty();
      for (const auto& e : made)
        for (const auto& landmark : e.landmarks) apart |= picks.apart_mm[{e.view, landmark}] > kApart_mm;
      for (auto& pick : picks.list)
        if (isExchanged(made, pick.landmark, pick.view)) pick.landmark = withOtherSide(pick.landmark);
      const double begin_s = threadTime_s();
      const auto finding = findExchangedSides(skeleton, views, picks.list, priors);
      row.seconds += (threadTime_s() - begin_s) / bodies;
      ++row.bodies;
      row.apart += apart;
      const bool right = setOf(finding.exchanges) == setOf(made);
      row.recognised += apart && right;
      row.partly += apart && !right && !finding.exchanges.empty();
      row.together += !apart && !finding.exchanges.empty();
      if (std::getenv("SINEW_PRINT_RESIDUALS") && !right)
        std::printf("%s, %s, body %d: made %s..., found '%s', evidence %.0f\n", row.body.c_str(), kind.c_str(), n + 1,
                    made.empty() ? "nothing"
                                 : (made[0].landmarks[0] + " in view " + std::to_string(made[0].view + 1)).c_str(),
                    finding.what.c_str(), finding.evidence),
            std::fflush(stdout);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace sinew

#include <cmath>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/swap_sides.h"
#include "app/cli/support/text_table.h"
#include "clinical/case/case_results_json.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/triangulate.h"

namespace sinew {
namespace {

constexpr double kMm = 1000;

Json pointJson(const TriangulatedLandmark& point) {
  const Eigen::Vector3d p = kMm * point.p_WL;
  const Eigen::Matrix3d cov = kMm * kMm * point.cov_W;
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({cov(i, 0), cov(i, 1), cov(i, 2)});
  return {{"name", point.name},
          {"p_mm", {p.x(), p.y(), p.z()}},
          {"covariance_mm2", rows},
          {"reprojection_rms_px", numberOrNull(point.reprojection_rms_px)}};
}

Json triangulationJson(const Triangulation& t) {
  Json points = Json::array();
  for (const auto& point : t.points) points.push_back(pointJson(point));
  return {{"format", "sinew.triangulation"},
          {"version", 1},
          {"points", points},
          {"rms_px", numberOrNull(t.rms_px)},
          {"warnings", warningsToJson(t.warnings)}};
}

std::string triangulationText(const Triangulation& t) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& point : t.points) {
    const double sd_mm = kMm * std::sqrt(point.cov_W.trace() / 3);
    rows.push_back({point.name, fixed(kMm * point.p_WL.x(), 2), fixed(kMm * point.p_WL.y(), 2),
                    fixed(kMm * point.p_WL.z(), 2), fixed(sd_mm, 2), fixed(point.reprojection_rms_px, 2)});
  }
  return textTable({"point", "x mm", "y mm", "z mm", "SD mm", "RMS px"}, rows) + "\n" +
         std::to_string(t.points.size()) + " points, reprojection RMS " + fixed(t.rms_px, 2) + " px\n";
}

}  // namespace

void addTriangulateCommand(Commands& commands) {
  struct Options {
    std::string rig, sightings;
    bool swap = false;
  };
  auto options = std::make_shared<Options>();
  auto& command =
      addCommand(commands.app, "triangulate", "points in space from what two views or more show, with covariance",
                 "sinew triangulate --rig rig.json --sightings picks.csv --json\n"
                 "  picks.csv: name,view,u_px,v_px[,sigma_px]; views count from 1; (0,0) = centre of the top-left "
                 "pixel");
  command.add_option("--rig", options->rig, "rig file")->required();
  command.add_option("--sightings", options->sightings, "CSV file of picks")->required();
  command.add_flag("--swap", options->swap, "exchange left and right where they are found exchanged");
  command.callback([&commands, options] {
    commands.chosen = [&session = commands.session, options] {
      const auto rig = loadRig(options->rig);
      auto sightings = loadSightings(options->sightings);
      const auto exchanges = examineAndSwap(session, rig, sightings, options->swap);
      const auto triangulation = triangulateAll(rig, sightings);
      session.warn(triangulation.warnings);
      if (triangulation.points.empty())
        throw InputError{{options->sightings, "name", "a point that is seen in two views", "none"}};
      Json json = triangulationJson(triangulation);
      json["exchanged_sides"] = exchangesToJson(exchanges);
      session.result(json, triangulationText(triangulation));
      return ExitStatus::Done;
    };
  });
}

}  // namespace sinew

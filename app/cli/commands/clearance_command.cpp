#include <algorithm>
#include <memory>
#include <numbers>
#include <tuple>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/model/bone_contacts.h"
#include "core/rom/poses/range_postures.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

struct Options {
  std::string model;
  int random_count = 200;
  double step_deg = 10;
  bool all = false;
};

// What counts as too far: attachments belong within 3 mm of a bone, paths no more than 2 mm inside one.
constexpr double kAttachment_m = 0.003;
constexpr double kPenetration_m = 0.002;

/// Coordinates of the joints that are not 0, in degrees: "hip_flexion_r 90".
std::string postureInWords(const Skeleton& skeleton, const Posture& q) {
  const Eigen::VectorXd clinical = clinicalFromPosture(skeleton, q);
  std::string text;
  int moved = 0;
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const double deg = clinical[i] * 180 / std::numbers::pi;
    if (std::abs(deg) < 0.05) continue;
    if (++moved > 2) return "many joints";
    text += (text.empty() ? "" : ", ") + skeleton.coordinates[static_cast<std::size_t>(i)].name + " " + fixed(deg, 0);
  }
  return text.empty() ? "zero" : text;
}

/// Depth over those postures in which the bones that the unit spans are apart, and how many these are.
std::pair<double, std::size_t> depthWithBonesApart(const Model& model, const BoneDistances& bones,
                                                   BoneContacts& contacts, const MusculotendonUnit& unit,
                                                   const std::vector<Posture>& postures) {
  std::vector<Posture> possible;
  for (const int k : contacts.posturesWithBonesApart(unit)) possible.push_back(postures[std::size_t(k)]);
  Model alone = model;
  alone.musculature.units = {unit};
  return {measurePenetration(alone, bones, possible).front().depth_m, possible.size()};
}

ExitStatus run(Session& session, const Options& options) {
  const Model model = session.model(options.model);
  const BoneDistances bones{model};
  const auto postures = rangePostures(model.skeleton, options.step_deg, options.random_count);
  const auto penetration = measurePenetration(model, bones, postures);
  const auto attachment = measureAttachments(model, bones);
  Json muscles = Json::array();
  std::vector<std::vector<std::string>> rows;
  BoneContacts contacts{model, bones, postures, kPenetration_m};
  int attached = 0, clear = 0, clear_apart = 0;
  const auto& units = model.musculature.units;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const auto& p = penetration[u];
    const auto& a = attachment[u];
    const bool good_ends = std::max(std::abs(a.origin_m), std::abs(a.insertion_m)) <= kAttachment_m;
    const bool good_path = p.depth_m < kPenetration_m;
    attached += good_ends;
    clear += good_path;
    double apart_m = p.depth_m;
    std::size_t apart_count = postures.size();
    if (!good_path) std::tie(apart_m, apart_count) = depthWithBonesApart(model, bones, contacts, units[u], postures);
    clear_apart += apart_m < kPenetration_m;
    const std::string where = p.posture < 0 ? "" : postureInWords(model.skeleton, postures[std::size_t(p.posture)]);
    muscles.push_back({{"name", units[u].name},
                       {"origin_mm", 1000 * a.origin_m},
                       {"origin_bone", a.origin_bone},
                       {"insertion_mm", 1000 * a.insertion_m},
                       {"insertion_bone", a.insertion_bone},
                       {"penetration_mm", 1000 * p.depth_m},
                       {"penetration_bones_apart_mm", 1000 * apart_m},
                       {"postures_bones_apart", apart_count},
                       {"bone", p.bone},
                       {"path_segment", p.path_segment},
                       {"posture", where}});
    if (options.all || !good_ends || !good_path)
      rows.push_back({units[u].name, fixed(1000 * a.origin_m, 1), fixed(1000 * a.insertion_m, 1),
                      fixed(1000 * p.depth_m, 1), fixed(1000 * apart_m, 1), std::to_string(apart_count), p.bone,
                      p.path_segment < 0 ? "" : std::to_string(p.path_segment), where});
  }
  std::string text = textTable(
      {"muscle", "origin mm", "insertion mm", "inside mm", "bones apart", "postures", "bone", "segment", "posture"},
      rows);
  text += std::to_string(attached) + " of " + std::to_string(units.size()) +
          " units have both ends within 3 mm of a bone; " + std::to_string(clear) +
          " stay less than 2 mm inside any bone over " + std::to_string(postures.size()) + " postures, " +
          std::to_string(clear_apart) + " where the bones that they span do not run into each other\n";
  session.result({{"format", "sinew.path_clearance"},
                  {"version", 1},
                  {"postures", postures.size()},
                  {"attached", attached},
                  {"clear", clear},
                  {"clear_bones_apart", clear_apart},
                  {"muscles", std::move(muscles)}},
                 text);
  return ExitStatus::Done;
}

}  // namespace

void addClearanceCommand(CLI::App& parent, Commands& commands) {
  auto options = std::make_shared<Options>();
  auto& command = addCommand(parent, "clearance",
                             "distance of attachments to the bones, and how far paths run through bones over the "
                             "normal range of motion; lists what is out of bounds",
                             "sinew model clearance reference --all");
  command.add_option("MODEL", options->model, "model file, or the word reference")->required();
  command.add_option("--random", options->random_count, "postures in which all joints move")->capture_default_str();
  command.add_option("--step-deg", options->step_deg, "step of the single coordinates")
      ->capture_default_str()
      ->check(CLI::Range(0.5, 90.0));
  command.add_flag("--all", options->all, "every muscle, not only those out of bounds");
  command.callback([&commands, options] {
    commands.chosen = [&session = commands.session, options] { return run(session, *options); };
  });
}

}  // namespace sinew

#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/io/motion/bvh_poses.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;

void addMake(CLI::App& parent, Commands& commands) {
  struct Options {
    std::string preset{kDefaultPreset}, output;
    PoseSampleOptions sample;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(parent, "make", "draw the synthetic pose set of a preset",
                             "sinew poses make --preset athlete --count 72000 --seed 2026 -o athlete.poses");
  command.add_option("--preset", o->preset, "average-adult or athlete")->capture_default_str();
  command.add_option("--count", o->sample.count, "postures at least, mirror images included")
      ->capture_default_str()
      ->check(CLI::Range(2, 100'000'000));
  command.add_option("--seed", o->sample.seed, "which set")->capture_default_str();
  command.add_option("-o,--output", o->output, "pose set file")->required();
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const Skeleton skeleton = loadReferenceSkeleton(session.resourceDir());
      const RomPreset preset = loadRomPreset(session.resourceDir(), o->preset, skeleton);
      const PoseSet set =
          sampledPoseSet(skeleton, preset, loadClinicalTests(session.resourceDir(), skeleton).tests, o->sample);
      set.save(o->output);
      session.result({{"format", "sinew.poses_made"},
                      {"version", 1},
                      {"preset", o->preset},
                      {"seed", o->sample.seed},
                      {"postures", set.size()},
                      {"file", o->output}},
                     std::to_string(set.size()) + " postures written to " + o->output + "\n");
      return ExitStatus::Done;
    };
  });
}

/// Smallest and largest value of every coordinate, in degrees; a file is read in blocks, so that its size does not
/// matter.
void addInfo(CLI::App& parent, Commands& commands) {
  auto file = std::make_shared<std::string>();
  auto& command = addCommand(parent, "info", "what a pose set holds: count, source, ranges of the joints",
                             "sinew poses info FILE");
  command.add_option("FILE", *file, "pose set file")->required();
  command.callback([&commands, file] {
    commands.chosen = [&session = commands.session, file] {
      const Skeleton skeleton = loadReferenceSkeleton(session.resourceDir());
      const PoseFileHeader header = readPoseFileHeader(*file, skeleton);
      const int n = skeleton.coordinateCount();
      Eigen::VectorXd low = Eigen::VectorXd::Constant(n, 1e9), high = -low;
      visitPoseFile(*file, skeleton, [&](const Eigen::MatrixXd& postures) {
        for (Eigen::Index i = 0; i < postures.cols(); ++i) {
          const Eigen::VectorXd clinical = clinicalFromPosture(skeleton, postures.col(i));
          low = low.cwiseMin(clinical);
          high = high.cwiseMax(clinical);
        }
      });
      Json ranges = Json::object();
      std::vector<std::vector<std::string>> rows;
      for (int i = 0; i < n && header.count > 0; ++i) {
        const Coordinate& c = skeleton.coordinates[i];
        const double unit = c.translational ? 1 : 1 / kRadPerDeg;
        ranges[c.name] = {low[i] * unit, high[i] * unit};
        rows.push_back({c.name, fixed(low[i] * unit, 1), fixed(high[i] * unit, 1), c.translational ? "m" : "deg"});
      }
      session.result({{"format", "sinew.poses_info"},
                      {"version", 1},
                      {"source", header.source},
                      {"postures", header.count},
                      {"ranges", ranges}},
                     std::to_string(header.count) + " postures: " + header.source + "\n" +
                         textTable({"coordinate", "from", "to", ""}, rows));
      return ExitStatus::Done;
    };
  });
}

void addImport(CLI::App& parent, Commands& commands) {
  struct Options {
    std::vector<std::string> files;
    std::string output;
    MotionImportOptions import;
    bool mirror = true;
    double tolerance_deg = 10;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(
      parent, "import", "postures from recorded motion (BVH) by inverse kinematics, mirrored, without outliers",
      "sinew poses import walk.bvh dance.bvh --step 10 -o motion.poses\n"
      "  Joints are known by CMU-style names (Hips, Spine, LeftUpLeg, LeftForeArm ...), with any prefix.");
  command.add_option("FILES", o->files, "BVH files")->required();
  command.add_option("-o,--output", o->output, "pose set file")->required();
  command.add_option("--step", o->import.step, "every step-th frame")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  command
      .add_option("--tolerance-deg", o->tolerance_deg, "beyond the athlete's range by more: left out as an outlier")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 180.0));
  command.add_flag("--mirror,!--no-mirror", o->mirror, "add the mirror image of every posture (default)");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const Skeleton skeleton = loadReferenceSkeleton(session.resourceDir());
      std::string names;
      for (const auto& file : o->files)
        names += (names.empty() ? "" : ", ") + std::filesystem::path{file}.filename().string();
      PoseSet all{skeleton, names};
      Json list = Json::array();
      std::vector<std::vector<std::string>> rows;
      for (const auto& file : o->files) {
        const std::string name = std::filesystem::path{file}.filename().string();
        const MotionImport import = importMotion(loadBvh(file), name, skeleton, o->import, session.job());
        if (session.job().cancelled()) return ExitStatus::NotConverged;
        std::size_t rejected = 0;
        all.append(withoutOutliers(import.poses, skeleton, o->tolerance_deg * kRadPerDeg, rejected));
        list.push_back({{"file", name},
                        {"frames", import.frames},
                        {"postures", import.poses.size() - rejected},
                        {"outliers", rejected},
                        {"metres_per_unit", import.scale},
                        {"rms_deg", import.rms_deg},
                        {"worst_deg", import.worst_deg},
                        {"worst_frame", import.worst_frame},
                        {"worst_segment", import.worst_segment},
                        {"unused_joints", import.unused}});
        rows.push_back({name, std::to_string(import.frames), std::to_string(import.poses.size() - rejected),
                        std::to_string(rejected), fixed(import.rms_deg, 2), fixed(import.worst_deg, 1),
                        import.worst_segment + " in frame " + std::to_string(import.worst_frame)});
      }
      const PoseSet result = o->mirror ? withMirrorImages(all, skeleton) : all;
      result.save(o->output);
      session.result({{"format", "sinew.poses_imported"},
                      {"version", 1},
                      {"files", list},
                      {"postures", result.size()},
                      {"file", o->output}},
                     textTable({"file", "frames", "postures", "outliers", "RMS deg", "worst deg", "where"}, rows) +
                         std::to_string(result.size()) + " postures written to " + o->output + "\n");
      return ExitStatus::Done;
    };
  });
}

}  // namespace

void addPosesCommands(Commands& commands) {
  auto& poses = addCommand(commands.app, "poses", "sets of postures: draw, import from recorded motion, describe",
                           "sinew poses make --preset average-adult -o adult.poses");
  poses.require_subcommand(1);
  addMake(poses, commands);
  addImport(poses, commands);
  addInfo(poses, commands);
}

}  // namespace sinew

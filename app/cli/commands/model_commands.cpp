#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/file.h"

namespace sinew {
namespace {

long countJoints(const Skeleton& skeleton, JointType type) {
  return std::ranges::count(skeleton.joints, type, &Joint::type);
}

/// Counts and sums of a model, with units in the names: for JSON and for people.
Json modelInfo(const Model& model) {
  const Skeleton& skeleton = model.skeleton;
  double mass_kg = 0;
  for (const auto& segment : skeleton.segments) mass_kg += segment.mass_kg;
  std::size_t path_points = 0;
  for (const auto& unit : model.musculature.units) path_points += unit.path.size();
  const long revolute = countJoints(skeleton, JointType::Revolute), ball = countJoints(skeleton, JointType::Ball);
  return {{"format", "sinew.model_info"},
          {"version", 1},
          {"name", model.name},
          {"segments", skeleton.segments.size()},
          {"moving_bodies", skeleton.movingSegmentCount()},
          {"joints", revolute + ball},  // the free root is no joint of the body
          {"revolute", revolute},
          {"ball", ball},
          {"coordinates", skeleton.coordinateCount()},
          {"muscles", model.musculature.units.size()},
          {"path_points", path_points},
          {"landmarks", skeleton.landmarks.size()},
          {"bones", model.bones->size()},
          {"mass_kg", mass_kg},
          {"changed_lengths", model.length_factors.size()}};
}

void addInfo(CLI::App& parent, Commands& commands) {
  auto name = std::make_shared<std::string>();
  auto& command = addCommand(parent, "info", "counts of segments, joints, coordinates, muscles",
                             "sinew model info reference --json");
  command.add_option("MODEL", *name, "model file, or reference, reference:athlete")->required();
  command.callback([&commands, name] {
    commands.chosen = [&session = commands.session, name] {
      const Json info = modelInfo(session.model(*name));
      std::vector<std::vector<std::string>> rows;
      for (const auto& [key, value] : info.items())
        if (key != "format" && key != "version")
          rows.push_back({key, value.is_string()         ? value.get<std::string>()
                               : value.is_number_float() ? fixed(value.get<double>(), 2)
                                                         : value.dump()});
      session.result(info, textTable({"", ""}, rows).substr(1));
      return ExitStatus::Done;
    };
  });
}

/// Odd, but no error: a finding that leaves the model usable.
bool isDoubt(const Warning& finding) {
  return finding.code == "muscle_standing_fiber" || finding.code == "muscle_overstretched" ||
         finding.code == "muscle_sides_differ";
}

void addValidate(CLI::App& parent, Commands& commands) {
  auto name = std::make_shared<std::string>();
  auto& command = addCommand(parent, "validate", "read a model strictly and check its invariants; 2 if any is broken",
                             "sinew model validate patient.json");
  command.add_option("MODEL", *name, "model file, or reference, reference:athlete")->required();
  command.callback([&commands, name] {
    commands.chosen = [&session = commands.session, name] {
      const Model model = session.model(*name);
      const Warnings findings = validateModel(model);
      std::string text;
      for (const auto& w : findings) text += w.message + " [" + w.code + "]\n";
      const bool valid = std::ranges::all_of(findings, isDoubt);
      text += *name + ": " + (valid ? "valid" : "not valid") + ", " + std::to_string(findings.size()) + " findings\n";
      session.result({{"format", "sinew.model_validation"},
                      {"version", 1},
                      {"model", *name},
                      {"valid", valid},
                      {"findings", warningsToJson(findings)}},
                     text);
      return valid ? ExitStatus::Done : ExitStatus::Unusable;
    };
  });
}

}  // namespace

void addModelCommands(Commands& commands) {
  auto& model = addCommand(commands.app, "model", "what a model holds, and whether it is sound",
                           "sinew model info reference --json");
  model.require_subcommand(1);
  addInfo(model, commands);
  addValidate(model, commands);
  addClearanceCommand(model, commands);
  addAuditCommand(model, commands);
  addMomentArmsCommand(model, commands);
  addPictureCommand(model, commands);
  addReplaceBonesCommand(model, commands);
  addShapeCommand(model, commands);
  addPhysicsCommand(model, commands);
}

}  // namespace sinew

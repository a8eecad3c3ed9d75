#include <cmath>
#include <memory>
#include <numbers>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "clinical/pipeline/phantom_calibration.h"
#include "core/text.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/rig_from_dicom.h"

namespace sinew {
namespace {

constexpr double kMm = 1000, kDeg = 180 / std::numbers::pi;

/// Properties of a view in words and numbers, with their unit in the name: for JSON and for people.
Json describe(const RigView& view) {
  Json json{{"role", nameOf(view.role)},
            {"exposure", view.exposure},
            {"projection", projectionName(view)},
            {"width_px", view.width_px},
            {"height_px", view.height_px}};
  if (const auto* c = std::get_if<ConeBeam>(&view.projection)) {
    json["focal_length_px"] = {c->fx_px, c->fy_px};
    json["principal_point_px"] = {c->cx_px, c->cy_px};
    const Eigen::Vector3d source_W = -view.R_CW.transpose() * view.p_CW;
    json["source_W_mm"] = {kMm * source_W.x(), kMm * source_W.y(), kMm * source_W.z()};
  } else if (const auto* s = std::get_if<SlotScan>(&view.projection)) {
    json["source_to_isocenter_mm"] = kMm * s->source_to_isocenter_m;
    json["spacing_mm"] = {kMm * s->column_spacing_m, kMm * s->row_spacing_m};
  } else if (const auto* o = std::get_if<Orthographic>(&view.projection)) {
    json["spacing_mm"] = {kMm * o->column_spacing_m, kMm * o->row_spacing_m};
  }
  return json;
}

Json rigInfo(const BiplanarRig& rig) {
  Json views = Json::array();
  for (const auto& view : rig.views) views.push_back(describe(view));
  return {{"format", "sinew.rig_info"},
          {"version", 1},
          {"method", rig.calibration.method},
          {"id", rig.calibration.id},
          {"patient_aligned", rig.patient_aligned},
          {"rms_px", numberOrNull(rig.calibration.rms_px)},
          {"accuracy_mm", numberOrNull(rig.calibration.accuracy_mm)},
          {"angle_between_views_deg", kDeg * angleBetweenViews_rad(rig)},
          {"views", views},
          {"warnings", warningsToJson(rig.calibration.warnings)}};
}

std::string rigText(const BiplanarRig& rig) {
  const auto& record = rig.calibration;
  std::string text = "calibration  " + record.method + ", id " + record.id;
  text += ", reprojection RMS " + (std::isfinite(record.rms_px) ? fixed(record.rms_px, 2) + " px" : "not stated");
  text += ", accuracy " + (std::isfinite(record.accuracy_mm) ? fixed(record.accuracy_mm, 2) + " mm" : "not stated");
  text += "\nworld        " + std::string(rig.patient_aligned ? "aligned with the patient (X anterior, Y up, Z right)"
                                                              : "frame of the calibration, not the patient's");
  text += "\nviews        " + fixed(kDeg * angleBetweenViews_rad(rig), 1) + " deg apart\n";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < rig.views.size(); ++i) {
    const Json view = describe(rig.views[i]);
    for (const auto& [name, value] : view.items()) {
      std::string cell;
      const Json numbers = value.is_array() ? value : Json::array({value});
      for (const auto& number : numbers)
        cell += (cell.empty() ? "" : ", ") + (number.is_number_float() ? fixed(number.get<double>(), 3)
                                              : number.is_string()     ? number.get<std::string>()
                                                                       : number.dump());
      rows.push_back({"view " + std::to_string(i + 1), name, cell});
    }
  }
  return text + textTable({"", "", ""}, rows);
}

void finish(Session& session, const BiplanarRig& rig, const std::string& output) {
  session.warn(rig.calibration.warnings);
  std::string text = rigText(rig);
  if (!output.empty()) {
    saveRig(rig, output);
    text += "written      " + output + "\n";
  }
  session.result(rigInfo(rig), text);
}

BiplanarRig importRig(const std::string& format, const std::vector<std::filesystem::path>& files) {
  const auto expect = [&](bool good, const std::string& count) {
    if (!good)
      throw InputError{{"sinew rig import", "FILES", count + " for " + format, std::to_string(files.size())}};
  };
  if (format == "json") {
    expect(files.size() == 1, "1");
    return loadRig(files[0]);
  }
  expect(files.size() >= 2, "2 or more");
  if (format != "dicom") return importTextCalibration(files, format);
  std::vector<Radiograph> images;
  for (const auto& file : files) images.push_back(readRadiograph(file));
  return rigFromDicom(images);
}

void addImport(CLI::App& rig, Commands& commands) {
  struct Options {
    std::string format, output;
    std::vector<std::filesystem::path> files;
  };
  auto options = std::make_shared<Options>();
  auto& command = addCommand(rig, "import", "turn another program's calibration into a rig file",
                             "sinew rig import --format autoscoper cam01.txt cam02.txt -o rig.json");
  command.add_option("--format", options->format, "autoscoper, mayacam, dicom or json")->required();
  command.add_option("FILES", options->files, "one file a view, frontal first; one for json")->required();
  command.add_option("-o,--output", options->output, "rig file to write");
  command.callback([&commands, options] {
    commands.chosen = [&session = commands.session, options] {
      static const std::vector<std::string> kFormats = {"autoscoper", "mayacam", "dicom", "json"};
      if (std::ranges::find(kFormats, options->format) == kFormats.end())
        throw InputError{{"sinew rig import", "--format", "autoscoper, mayacam, dicom or json",
                          "'" + options->format + "'" + didYouMean(options->format, kFormats)}};
      finish(session, importRig(options->format, options->files), options->output);
      return ExitStatus::Done;
    };
  });
}

void addCalibrate(CLI::App& rig, Commands& commands) {
  struct Options {
    std::vector<std::filesystem::path> images;
    std::filesystem::path beads, sightings;
    std::string output;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(rig, "calibrate", "cone-beam views from images of a bead phantom",
                             "sinew rig calibrate --image ap.dcm --image lateral.dcm --beads beads.csv -o rig.json");
  command.add_option("--image", o->images, "image of the phantom, once a view: frontal, lateral, others")->required();
  command.add_option("--beads", o->beads, "its beads (CSV name,x_mm,y_mm,z_mm[,diameter_mm])")->required();
  command.add_option("--sightings", o->sightings, "picked beads (CSV name,view,u_px,v_px) instead of detecting them");
  command.add_option("-o,--output", o->output, "rig file to write");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const auto& images = o->images;
      if (images.size() < 2)
        throw InputError{{"sinew rig calibrate", "--image", "two images or more", std::to_string(images.size())}};
      const auto calibration = o->sightings.empty()
                                   ? calibrateFromPhantom(images, o->beads, session.job())
                                   : calibrateFromPickedBeads(images, o->beads, o->sightings, session.job());
      if (calibration.outcome == Outcome::Converged) {
        finish(session, calibration.rig, o->output);
      } else {
        session.note(std::string{nameOf(calibration.outcome)});
        session.result({{"format", "sinew.rig_info"}, {"version", 1}, {"outcome", nameOf(calibration.outcome)}}, "");
      }
      return statusOf(calibration.outcome);
    };
  });
}

void addInfo(CLI::App& rig, Commands& commands) {
  auto file = std::make_shared<std::string>();
  auto& command = addCommand(rig, "info", "say what a rig file holds", "sinew rig info rig.json --json");
  command.add_option("RIG", *file, "rig file")->required();
  command.callback([&commands, file] {
    commands.chosen = [&session = commands.session, file] {
      finish(session, loadRig(*file), "");
      return ExitStatus::Done;
    };
  });
}

}  // namespace

void addRigCommands(Commands& commands) {
  auto& rig = addCommand(commands.app, "rig", "view geometry: import, calibrate, inspect",
                         "sinew rig import --format autoscoper cam01.txt cam02.txt -o rig.json");
  rig.require_subcommand(1);
  addImport(rig, commands);
  addCalibrate(rig, commands);
  addInfo(rig, commands);
}

}  // namespace sinew

#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/patient_options.h"
#include "clinical/case/case_io.h"
#include "clinical/case/patient_edit.h"
#include "clinical/pipeline/pipeline.h"

namespace sinew {
namespace {

/// Name and id are left out: what a command prints ends up in logs.
Json patientJson(const Patient& p) {
  return {{"sex", p.sex},
          {"birth_date", p.birth_date},
          {"height_m", numberOrNull(p.height_m)},
          {"mass_kg", numberOrNull(p.mass_kg)},
          {"diagnosis", p.diagnosis}};
}

std::string patientText(const Patient& p) {
  const auto known = [](const std::string& text) { return text.empty() ? std::string{"unknown"} : text; };
  const auto figure = [](const std::optional<double>& value, const char* unit) {
    char text[48] = "unknown";
    if (value) std::snprintf(text, sizeof text, "%g %s", *value, unit);
    return std::string{text};
  };
  return "sex         " + known(p.sex) + "\nbirth date  " + known(p.birth_date) + "\nheight      " +
         figure(p.height_m, "m") + "\nmass        " + figure(p.mass_kg, "kg") + "\ndiagnosis   " +
         known(p.diagnosis) + "\n";
}

ExitStatus showOrChange(const std::filesystem::path& folder, const PatientOptions& options, Session& session) {
  Case c = loadCase(folder);
  Patient patient = c.patient;
  options.applyTo(patient);
  Json stale = Json::array();
  std::string text;
  if (!(patient == c.patient)) {
    const auto before = statusOf(c, session.resourceDir());
    setPatient(c, patient, dateToday());
    session.warn(patientDoubts(c, ""));
    saveCase(c, folder);
    for (const auto& now : statusOf(c, session.resourceDir()))
      if (now.state == StageState::Stale && before.at(std::size_t(now.stage)).state == StageState::Done)
        stale.push_back(nameOf(now.stage));
    for (const auto& name : stale) text += (text.empty() ? "out of date now: " : ", ") + name.get<std::string>();
    if (!text.empty()) text += "; next: sinew run " + folder.string() + "\n";
  }
  session.result({{"format", "sinew.patient"}, {"version", 1}, {"patient", patientJson(c.patient)}, {"stale", stale}},
                 patientText(c.patient) + text);
  return ExitStatus::Done;
}

}  // namespace

void addPatientCommand(Commands& commands) {
  struct Options {
    std::filesystem::path folder;
    PatientOptions patient;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "patient", "show or change what is known of the patient",
                             "sinew patient mycase --mass-kg 54 --birth-date 2014-03-09\n"
                             "  'unknown' takes a figure back. Stages that read what changed are out of date then.");
  command.add_option("CASE", o->folder, "case folder")->required();
  o->patient.addTo(command);
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] { return showOrChange(o->folder, o->patient, session); };
  });
}

}  // namespace sinew

#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/patient_options.h"
#include "clinical/case/new_case.h"
#include "clinical/exam/physical_exam.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {
namespace {

struct NewOptions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> images, phantom;
  std::filesystem::path exam, rig, sightings, beads;
  std::optional<double> pixel_size_mm;
  PatientOptions patient;
};

NewCase wantedBy(const NewOptions& o, Session& session) {
  if (o.phantom.empty() != o.beads.empty())
    throw InputError{{"sinew new", "--phantom", "phantom images together with --beads", "one without the other"}};
  NewCase wanted;
  wanted.images = o.images;
  wanted.declared_spacing_mm = o.pixel_size_mm;
  o.patient.applyTo(wanted.patient);
  if (!o.phantom.empty()) wanted.phantom = PhantomFiles{o.phantom, o.beads};
  if (!o.rig.empty()) wanted.rig = loadRig(o.rig);
  if (!o.sightings.empty()) wanted.sightings = loadSightings(o.sightings);
  if (!o.exam.empty()) {
    wanted.exam = loadExam(o.exam);
    session.warn(checkExam(wanted.exam, loadClinicalTests(session.resourceDir())));
  }
  return wanted;
}

ExitStatus makeNew(const NewOptions& o, Session& session) {
  session.warn(makeCase(wantedBy(o, session), o.folder, dateToday()).doubts);
  session.result({{"format", "sinew.new"}, {"version", 1}, {"case", o.folder.string()}},
                 "made " + o.folder.string() + "; next: sinew run " + o.folder.string() + "\n");
  return ExitStatus::Done;
}

}  // namespace

void addNewCommand(Commands& commands) {
  auto o = std::make_shared<NewOptions>();
  auto& command =
      addCommand(commands.app, "new", "make a case folder from two or more radiographs",
                 "sinew new mycase --image ap.dcm --image lateral.dcm --sightings picks.csv --exam exam.json");
  command.add_option("CASE", o->folder, "folder to make")->required();
  command.add_option("--image", o->images, "radiograph, once a view: frontal, lateral, others")->required();
  command.add_option("--exam", o->exam, "physical examination (JSON)");
  command.add_option("--rig", o->rig, "view geometry (rig file)");
  command.add_option("--phantom", o->phantom, "image of the bead phantom, once a view in the same order");
  command.add_option("--beads", o->beads, "beads of the phantom (CSV name,x_mm,y_mm,z_mm)");
  command.add_option("--sightings", o->sightings, "landmark picks (CSV name,view,u_px,v_px[,sigma_px])");
  command.add_option("--pixel-size-mm", o->pixel_size_mm, "size of a pixel, for images that do not state it");
  o->patient.addTo(command);
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makeNew(*o, session); }; });
}

}  // namespace sinew

#include "clinical/pipeline/pipeline.h"

#include <gmock/gmock.h>

#include <functional>
#include <sstream>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/run_case.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/synthetic/synthetic_case.h"
#include "core/file.h"
#include "core/model/rom_preset.h"
#include "core/text.h"
#include "imaging/radiograph/radiograph.h"
#include "tests/support/resources.h"
#include "tests/support/retarget_reference.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Model& referenceModel() {
  return test::retargetReference()->model();
}

std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

/// A grey image of the size of a view, as a DICOM file.
FileReference writeImage(const View& view, const std::string& position, const std::filesystem::path& folder,
                         const std::string& name) {
  Radiograph image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  image.bits_stored = 12;
  std::vector<std::uint16_t> pixels(std::size_t(view.width_px) * std::size_t(view.height_px), 1000);
  for (std::size_t i = 0; i < pixels.size(); i += 7) pixels[i] = std::uint16_t(i % 4000);
  image.pixels = std::make_shared<const std::vector<std::uint16_t>>(std::move(pixels));
  image.window_center = 2000, image.window_width = 4000;
  image.tags.modality = "DX";
  image.tags.view_position = position;
  std::filesystem::create_directories((folder / name).parent_path());
  writeDicom(image, folder / name);
  return {name, sha256OfFile(folder / name)};
}

/// A drawn patient seen through a known rig: everything that stages read, without the time to render radiographs.
class PipelineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    SyntheticOptions options;
    options.resource_dir = test::resourceDir();
    options.seed = 3;
    options.binning = 4;  // small images: what is in them does not matter here
    const auto patient = drawSyntheticPatient(*test::retargetReference(), options);
    c_.patient = patient.patient;
    c_.sightings = patient.sightings;
    c_.exam = patient.exam;
    c_.truth = patient.truth;
    c_.imported_rig = patient.true_rig;
    c_.images = {{writeImage(patient.true_rig.views[0], "AP", folder_.path(), "images/view1.dcm"), {}},
                 {writeImage(patient.true_rig.views[1], "LL", folder_.path(), "images/view2.dcm"), {}}};
    context_.resource_dir = test::resourceDir();
    context_.case_dir = folder_.path();
    context_.reference = &referenceModel();
    context_.retargeting = test::retargetReference;
    context_.write_report = [](const Case&, const std::filesystem::path&, const std::filesystem::path& pdf) {
      writeFileAtomically(pdf, "%PDF-1.7 test");
    };
  }

  void runTo(Stage last) {
    for (const Stage stage : kStages) {
      c_ = runStage(c_, stage, context_);
      ASSERT_EQ(c_.stages.at(stage).outcome, Outcome::Converged) << nameOf(stage);
      ASSERT_EQ(stateOf(c_, stage, test::resourceDir()), StageState::Done) << nameOf(stage);
      if (stage == last) return;
    }
  }

  test::TemporaryFolder folder_;
  Case c_;
  PipelineContext context_;
};

TEST_F(PipelineTest, GoesTheWholeWay) {
  runTo(Stage::Report);
  EXPECT_EQ(readFile(checkedFile(*c_.report, folder_.path())), "%PDF-1.7 test");
  const Model model = loadModel(checkedFile(*c_.model, folder_.path()), referenceModel());
  EXPECT_EQ(model.shape, c_.skeleton->shape);
  EXPECT_EQ(model.length_factors, c_.exam_fit->length_factors);
  EXPECT_THAT(c_.exam_fit->tests, ::testing::Not(IsEmpty()));
  for (const auto& t : compareWithTruth(c_))
    if (t.quantity == "femur_length") {
      EXPECT_NEAR(t.estimate, t.truth, 6);  // mm; three SD of a length at picks of 1 mm
    }
  EXPECT_TRUE(caseFromJson(caseToJson(c_), "case") == c_);
  for (const auto& [stage, record] : c_.stages) {
    EXPECT_EQ(record.input_hash, inputHash(c_, stage, test::resourceDir())) << nameOf(stage);
    EXPECT_THAT(record.summary, ::testing::Not(HasSubstr(c_.patient.name))) << nameOf(stage);
  }
}

TEST_F(PipelineTest, AStageWaitsForThoseBeforeIt) {
  EXPECT_THAT(complaintOf([&] { runStage(c_, Stage::Landmarks, context_); }),
              HasSubstr("stage landmarks: images: expected done, found ready"));
  runTo(Stage::Skeleton);
  c_.sightings[0].uv_px.x() += 2;
  EXPECT_THAT(complaintOf([&] { runStage(c_, Stage::Skeleton, context_); }),
              HasSubstr("stage skeleton: landmarks: expected done, found stale"));
  EXPECT_THAT(complaintOf([&] { runStage(c_, Stage::Report, context_); }), HasSubstr("found stale"));
}

TEST_F(PipelineTest, ACancelledStageKeepsTheEarlierResultAndSaysSo) {
  runTo(Stage::Skeleton);
  const auto before = c_.skeleton->shape;
  std::stop_source stop;
  stop.request_stop();
  const Case after = runStage(c_, Stage::Skeleton, context_, {.report_to = {}, .stop = stop.get_token()});
  EXPECT_EQ(after.stages.at(Stage::Skeleton).outcome, Outcome::Cancelled);
  ASSERT_TRUE(after.skeleton);
  EXPECT_EQ(after.skeleton->shape, before);
  EXPECT_EQ(stateOf(after, Stage::Skeleton, test::resourceDir()), StageState::Stale);
  EXPECT_THAT(reasonsAgainstReport(after, test::resourceDir()), Contains("Skeleton: stale"));
}

TEST_F(PipelineTest, ModelOfAFinishedExaminationKeepsItsLengthsWhenMadeAgain) {
  runTo(Stage::Exam);
  const auto model = c_.model;
  c_ = runStage(c_, Stage::Musculature, context_);
  EXPECT_EQ(c_.model, model);
  EXPECT_EQ(stateOf(c_, Stage::Exam, test::resourceDir()), StageState::Done);
}

TEST_F(PipelineTest, MusculatureMadeAnewFromOtherReferenceDataStillCarriesTheExaminationThatHolds) {
  runTo(Stage::Exam);
  const auto model = c_.model;
  c_.stages[Stage::Musculature].input_hash = "of other reference data";
  c_ = runStage(c_, Stage::Musculature, context_);  // the same musculature comes out
  EXPECT_EQ(stateOf(c_, Stage::Exam, test::resourceDir()), StageState::Done);
  EXPECT_EQ(c_.model, model);
}

/// What a run told: "+skeleton" ran, "-exam" was passed over.
std::string told(const Case& c, const RunRequest& request, const PipelineContext& context,
                 CaseRun* result = nullptr) {
  std::string text;
  RunObserver observer;
  observer.passed_over = [&](const Case&, const StageStatus& status) { text += " -" + nameOf(status.stage); };
  observer.ended = [&](const Case&, Stage stage) { text += " +" + nameOf(stage); };
  CaseRun run = runCase(c, request, context, observer);
  if (result) *result = run;
  return text;
}

TEST_F(PipelineTest, ARunTakesTheStagesThatAreNotDone) {
  CaseRun run;
  EXPECT_EQ(told(c_, {{}, Stage::Landmarks}, context_, &run), " +images +calibration +landmarks");
  EXPECT_EQ(told(run.c, {{}, Stage::Landmarks}, context_), " -images -calibration -landmarks");
  EXPECT_EQ(told(run.c, {Stage::Calibration, Stage::Landmarks}, context_), " -images +calibration +landmarks");
  Case c = run.c;
  c.sightings.clear();
  EXPECT_EQ(told(c, {}, context_, &run), " -images -calibration -landmarks -skeleton -musculature -exam -report");
  EXPECT_FALSE(run.refused);
  EXPECT_EQ(told(c, {{}, Stage::Skeleton}, context_, &run), " -images -calibration");
  ASSERT_TRUE(run.refused);
  EXPECT_THAT(run.refused->what(), HasSubstr("no landmark has been picked"));
}

TEST_F(PipelineTest, ARunMakesAgainWhatWasLost) {
  runTo(Stage::Exam);
  writeFileAtomically(folder_ / "results/model.json", "{}");
  CaseRun run;
  EXPECT_EQ(told(c_, {{}, Stage::Exam}, context_, &run),
            " -images -calibration -landmarks -skeleton -musculature +exam");
  EXPECT_TRUE(isUndamaged(*run.c.model, folder_.path()));
  EXPECT_EQ(run.c.model, c_.model);
  std::filesystem::remove(folder_ / c_.musculature->path);
  EXPECT_EQ(told(c_, {{}, Stage::Exam}, context_, &run),
            " -images -calibration -landmarks -skeleton +musculature -exam");
  EXPECT_TRUE(isUndamaged(*run.c.musculature, folder_.path()));
}

TEST_F(PipelineTest, ResultsAreNotWrittenThroughALinkThatLeadsOut) {
  runTo(Stage::Skeleton);
  const test::TemporaryFolder outside;
  std::filesystem::create_directory_symlink(outside.path(), folder_ / "results");
  EXPECT_THAT(complaintOf([&] { runStage(c_, Stage::Musculature, context_); }), HasSubstr("leads out"));
  EXPECT_TRUE(std::filesystem::is_empty(outside.path()));
}

TEST_F(PipelineTest, AReportThatCannotBeDrawnLeavesTheEarlierOne) {
  runTo(Stage::Report);
  context_.write_report = [](const Case&, const std::filesystem::path&, const std::filesystem::path& pdf) {
    writeFileAtomically(pdf, "half a page");
    throw InputError{"report: no font"};
  };
  EXPECT_THROW(runStage(c_, Stage::Report, context_), InputError);
  EXPECT_EQ(readFile(checkedFile(*c_.report, folder_.path())), "%PDF-1.7 test");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "results")) files += entry.is_regular_file();
  EXPECT_EQ(files, 2);  // model and report: nothing half-written
}

/// The files of the resources that the row of a stage lists, and no others.
void copyResourcesOf(Stage stage, const std::filesystem::path& folder) {
  for (const char* path : rowOf(stage).resources) {
    std::filesystem::create_directories((folder / path).parent_path());
    std::filesystem::copy(test::resourceDir() / path, folder / path);
  }
}

/// The reference model as far as those files make it.
Model referenceFrom(const std::filesystem::path& resource_dir) {
  if (std::filesystem::exists(resource_dir / "muscles")) return loadReferenceModel(resource_dir);
  Model model = referenceModel();
  model.skeleton = loadReferenceSkeleton(resource_dir);
  if (std::filesystem::exists(resource_dir / "rom"))
    setStops(model.skeleton, loadRomPreset(resource_dir, kDefaultPreset, model.skeleton));
  return model;
}

TEST_F(PipelineTest, AStageReadsNothingThatItsRowDoesNotList) {
  runTo(Stage::Exam);
  for (const Stage stage : {Stage::Landmarks, Stage::Skeleton, Stage::Musculature, Stage::Exam}) {
    const test::TemporaryFolder resources;
    copyResourcesOf(stage, resources.path());
    PipelineContext context = context_;
    context.resource_dir = resources.path();
    const Model reference = referenceFrom(resources.path());
    context.reference = &reference;
    context.retargeting = {};  // read from the resources
    Case c = c_;
    if (stage < Stage::Exam) c.exam_fit.reset();  // a later run of the stage would keep its lengths
    for (const Stage earlier : kStages)
      if (earlier < stage) c.stages[earlier].input_hash = inputHash(c, earlier, resources.path());
    Case again = runStage(c, stage, context);
    EXPECT_EQ(again.stages.at(stage).summary, c_.stages.at(stage).summary) << nameOf(stage);
  }
}

TEST_F(PipelineTest, UnusableImagesAreNamed) {
  Case c = c_;
  c.images[1] = c.images[0];
  EXPECT_THAT(complaintOf([&] { runStage(c, Stage::Images, context_); }), HasSubstr("the same file twice"));
  c = c_;
  c.imported_rig->views[1].width_px += 10;
  c = runStage(c, Stage::Images, context_);
  EXPECT_THAT(complaintOf([&] { runStage(c, Stage::Calibration, context_); }),
              AllOf(HasSubstr("view 2"), HasSubstr("as calibrated")));
  writeFileAtomically(folder_ / "images/view2.dcm", "not the file that was imported");
  EXPECT_THAT(complaintOf([&] { runStage(c_, Stage::Images, context_); }), HasSubstr("changed or damaged"));
}

TEST_F(PipelineTest, WarnsOfWhatNobodyPickedOrMeasured) {
  std::erase_if(c_.sightings, [](const Sighting& s) { return s.name == "asis_r"; });
  c_.sightings.push_back({"asis_rr", 0, {10, 10}, 1});
  c_.exam.entries.clear();
  c_.patient.mass_kg.reset();
  runTo(Stage::Exam);
  const auto codes = [&](Stage stage, const std::string& code) {
    return ::testing::Value(c_.stages.at(stage).warnings, Contains(Field(&Warning::code, code)));
  };
  EXPECT_TRUE(codes(Stage::Landmarks, "landmarks_missing"));
  EXPECT_TRUE(codes(Stage::Landmarks, "unknown_landmark"));
  EXPECT_TRUE(codes(Stage::Musculature, "model_mass_unknown"));
  EXPECT_TRUE(codes(Stage::Exam, "nothing_measured"));
  EXPECT_TRUE(codes(Stage::Exam, "mass_unknown"));
}

TEST(Pipeline, ARealWristPairIsTriangulatedAndThenLacksKnownLandmarks) {
  SINEW_NEEDS_EXTERNAL("biplane_wrist/beads.csv");
  const auto data = external_file.parent_path();
  const test::TemporaryFolder folder;
  Case c;
  c.images = {{importFile(data / "xr_rad_uln_cam01_UND.0099.tif", folder.path(), "images/view1.tif"), {}},
              {importFile(data / "xr_rad_uln_cam02_UND.0099.tif", folder.path(), "images/view2.tif"), {}}};
  const std::vector<std::filesystem::path> calibration = {data / "xr_calib_wrist_cam01.txt",
                                                          data / "xr_calib_wrist_cam02.txt"};
  c.imported_rig = importTextCalibration(calibration, "autoscoper");
  std::map<std::string, Eigen::Vector3d> truth_m;
  std::istringstream in{readFile(external_file)};
  for (std::string line; std::getline(in, line);) {
    const auto cells = splitCsvLine(line);
    if (cells.size() != 8 || cells[0] == "bead") continue;
    const auto value = [&](std::size_t i) { return parseNumber(cells[i], "beads", "value"); };
    c.sightings.push_back({cells[0], 0, {value(1), value(2)}, 0.5});
    c.sightings.push_back({cells[0], 1, {value(3), value(4)}, 0.5});
    truth_m[cells[0]] = Eigen::Vector3d{value(5), value(6), value(7)} / 1000;
  }
  PipelineContext context{test::resourceDir(), folder.path(), &referenceModel(), {}, {}};
  for (const Stage stage : {Stage::Images, Stage::Calibration, Stage::Landmarks}) c = runStage(c, stage, context);
  ASSERT_EQ(c.landmarks->points.size(), 4u);
  EXPECT_LT(c.landmarks->rms_px, 0.5);
  for (const auto& point : c.landmarks->points)  // 0.2 mm: twice the accuracy stated with the table
    EXPECT_LT((point.p_WL - truth_m.at(point.name)).norm(), 0.2e-3) << point.name;
  EXPECT_EQ(stateOf(c, Stage::Skeleton, test::resourceDir()), StageState::Missing);
  EXPECT_EQ(stateOf(c, Stage::Musculature, test::resourceDir()), StageState::Blocked);
  EXPECT_THAT(complaintOf([&] { runStage(c, Stage::Skeleton, context); }), HasSubstr("no known landmark"));
}

}  // namespace
}  // namespace sinew

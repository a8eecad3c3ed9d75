#include "app/model/workspace.h"

#include "clinical/case/patient_body.h"
#include "clinical/synthetic/synthetic_case.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

/// What the patient's model is made from, so that it is rebuilt only then.
std::string modelKey(const CaseDocument& document) {
  const Case& c = document.current();
  if (!c.skeleton || c.skeleton->outcome != Outcome::Converged) return {};
  std::string key;
  for (const double value : toVector(c.skeleton->shape)) key += std::to_string(value) + ' ';
  if (c.musculature) key += c.musculature->sha256;
  if (c.model) key += c.model->sha256;
  key +=
      std::to_string(c.patient.mass_kg.value_or(0)) + ' ' + std::to_string(ageYears(c.patient, c.exam).value_or(-1));
  for (const Stage stage : {Stage::Musculature, Stage::Exam})  // what is out of date is not used
    key += document.stateOf(stage) == StageState::Done ? '1' : '0';
  return key;
}

}  // namespace

Workspace::Workspace(std::filesystem::path resource_dir, ReportWriter write_report, QObject* parent)
    : QObject{parent},
      resource_dir_{std::move(resource_dir)},
      write_report_{std::move(write_report)},
      document_{resource_dir_} {
  connect(&document_, &CaseDocument::rejected, this, &Workspace::problem);
  connect(&document_, &CaseDocument::replaced, this, [this] {
    jobs_.cancel();
    images_.clear();
    view_.reset();
  });
  connect(&jobs_, &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) emit problem(message);
    if (ending == JobRunner::Ending::Cancelled) emit notice(tr("Cancelled: %1").arg(jobs_.title()));
  });
}

std::shared_ptr<const Model> Workspace::reference() {
  const std::scoped_lock lock{reference_mutex_};
  if (!reference_) reference_ = std::make_shared<const Model>(loadReferenceModel(resource_dir_));
  return reference_;
}

std::shared_ptr<const RetargetReference> Workspace::retargeting() {
  const std::scoped_lock lock{retargeting_mutex_};
  if (!retargeting_) retargeting_ = loadRetargetReference(resource_dir_);
  return retargeting_;
}

const ClinicalTests& Workspace::protocol() {
  if (!protocol_) protocol_ = loadClinicalTests(resource_dir_);
  return *protocol_;
}

const NormTable& Workspace::norms() {
  if (!norms_) norms_ = loadNorms(resource_dir_);
  return *norms_;
}

std::shared_ptr<const Model> Workspace::patientModel() {
  const Case& c = document_.current();
  const std::string key = modelKey(document_);
  if (key != patient_model_key_) {
    patient_model_.reset();
    patient_model_key_.clear();
    if (!key.empty())
      if (auto model = sinew::patientModel(c, *reference(), document_.folder(), resource_dir_))
        patient_model_ = std::make_shared<const Model>(std::move(*model));
    patient_model_key_ = key;
  }
  return patient_model_;
}

QString Workspace::patientModelTitle() const {
  const auto& skeleton = document_.current().skeleton;
  if (!document_.isOpen() || !skeleton || skeleton->outcome != Outcome::Converged) return {};
  if (document_.stateOf(Stage::Exam) == StageState::Done) return tr("This patient");
  if (document_.stateOf(Stage::Musculature) == StageState::Done) return tr("This patient, before the examination");
  return tr("This patient, bones only");
}

void Workspace::run(const RunRequest& request) {
  StageServices services{resource_dir_, [this] { return reference(); }, [this] { return retargeting(); }, {}};
  if (write_report_)
    services.write_report = [this](const Case& c, const std::filesystem::path& case_dir,
                                   const std::filesystem::path& pdf) {
      write_report_(c, case_dir, pdf, *reference(), resource_dir_);
    };
  if (!runStages(document_, jobs_, services, request))
    emit problem(tr("Another computation is still going on: wait for it or cancel it."));
}

void Workspace::openCase(const std::filesystem::path& folder) {
  try {
    document_.open(folder);
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

void Workspace::saveCase(bool overwrite) {
  if (!document_.isOpen()) return;
  try {
    document_.save(overwrite);
    emit notice(tr("Case saved"));
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

void Workspace::makeDemo(const std::filesystem::path& folder, bool slot_scan) {
  try {
    expectDemoFolder(folder);
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
    return;
  }
  if (std::filesystem::exists(folder / "case.json")) {  // an earlier demo
    openCase(folder);
    return;
  }
  const bool started = jobs_.start(tr("Make the demo patient"), [=, this](const Job& job) -> JobRunner::Finish {
    SyntheticOptions options;
    options.resource_dir = resource_dir_;
    if (slot_scan) options.rig = SyntheticRig::SlotScan;
    const auto patient = drawSyntheticPatient(*retargeting(), options);
    auto made = std::make_shared<Case>(writeSyntheticCase(patient, *reference(), options, folder, job));
    return [=, this] { document_.adopt(*made, folder); };
  });
  if (!started) emit problem(tr("Another computation is still going on: wait for it or cancel it."));
}

}  // namespace sinew

#pragma once
#include <QObject>
#include <filesystem>
#include <memory>
#include <mutex>

#include "app/model/case_document.h"
#include "app/model/image_store.h"
#include "app/model/job_runner.h"
#include "app/model/stage_runner.h"
#include "app/model/view_state.h"
#include "clinical/report/norms.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

class RetargetReference;

/// Everything the panels of a window share.
class Workspace : public QObject {
  Q_OBJECT
 public:
  /// Draws the report; supplied by the application, because it needs fonts. Called on a worker thread.
  using ReportWriter =
      std::function<void(const Case&, const std::filesystem::path& case_dir, const std::filesystem::path& pdf,
                         const Model& reference, const std::filesystem::path& resource_dir)>;

  Workspace(std::filesystem::path resource_dir, ReportWriter write_report, QObject* parent = nullptr);

  CaseDocument& document() { return document_; }
  ViewState& view() { return view_; }
  JobRunner& jobs() { return jobs_; }
  ImageStore& images() { return images_; }
  const std::filesystem::path& resourceDir() const { return resource_dir_; }

  /// The reference model, read at the first call; from any thread. @throws InputError.
  std::shared_ptr<const Model> reference();
  /// What musculatures are retargeted from, made at the first call (a second); from any thread. @throws InputError.
  std::shared_ptr<const RetargetReference> retargeting();
  /// The forms of the examination. GUI thread. @throws InputError.
  const ClinicalTests& protocol();
  /// Titles and conventions of the figures. GUI thread. @throws InputError.
  const NormTable& norms();
  /// The patient's model as far as the case has got; nullptr before the skeleton is fitted. Kept until the results it
  /// is made from change. GUI thread. @throws InputError.
  std::shared_ptr<const Model> patientModel();

  /// "This patient, bones only": the name of patientModel() in lists, with how far it has got; empty: there is none.
  QString patientModelTitle() const;

  /// Runs the stages that wait, or one again with those before it that wait.
  void run(const RunRequest& request);
  void runStage(Stage stage) { run({stage, stage}); }
  void runAll() { run({}); }

  void openCase(const std::filesystem::path& folder);  ///< answers an unusable folder by problem()
  void saveCase(bool overwrite = false);
  /// Makes the embedded demo patient in `folder` and opens it, or opens the one that is there; a folder that holds
  /// anything else is refused by problem().
  void makeDemo(const std::filesystem::path& folder, bool slot_scan);

 signals:
  void problem(const QString& message);  ///< one line for the banner
  void notice(const QString& message);

 private:
  std::filesystem::path resource_dir_;
  ReportWriter write_report_;
  CaseDocument document_;
  ViewState view_;
  ImageStore images_;
  std::mutex reference_mutex_;
  std::shared_ptr<const Model> reference_;
  std::mutex retargeting_mutex_;
  std::shared_ptr<const RetargetReference> retargeting_;
  std::optional<ClinicalTests> protocol_;
  std::optional<NormTable> norms_;
  std::string patient_model_key_;
  std::shared_ptr<const Model> patient_model_;
  JobRunner jobs_;  ///< last: its thread ends before what it uses goes
};

}  // namespace sinew

#pragma once
#include <QDialog>
#include <filesystem>
#include <memory>

#include "app/widgets/shell/patient_form.h"
#include "clinical/case/new_case.h"

class QFormLayout;
class QLabel;
class QLineEdit;

namespace sinew {

/// Form of a new case: patient, two radiographs, folder.
class NewCaseDialog : public QDialog {
  Q_OBJECT
 public:
  explicit NewCaseDialog(QWidget* parent = nullptr);

  /// @throws InputError naming the field that is missing or cannot be used.
  NewCase wanted() const;
  std::filesystem::path folder() const;

 private:
  void accept() override;
  QLineEdit* addPath(QFormLayout& form, const QString& object_name, const QString& label, bool is_folder);

  QLineEdit* spacing_mm_;
  std::unique_ptr<PatientForm> patient_;
  QLineEdit *frontal_, *lateral_, *folder_;
  QLabel* problem_;
};

}  // namespace sinew

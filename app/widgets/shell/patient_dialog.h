#pragma once
#include <QDialog>
#include <memory>

#include "app/widgets/shell/patient_form.h"

class QLabel;

namespace sinew {

class CaseDocument;

/// What is known of the patient of the open case, to be read and changed at any time; one undo step.
class PatientDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PatientDialog(CaseDocument& document, QWidget* parent = nullptr);

  /// Changes the case; stays open and says why if something stated cannot be.
  void accept() override;

 private:
  CaseDocument& document_;
  std::unique_ptr<PatientForm> form_;
  QLabel* problem_;
};

}  // namespace sinew

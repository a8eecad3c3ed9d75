#include "app/widgets/shell/patient_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/case_document.h"
#include "app/widgets/controls/theme.h"
#include "clinical/case/patient_edit.h"

namespace sinew {

PatientDialog::PatientDialog(CaseDocument& document, QWidget* parent) : QDialog{parent}, document_{document} {
  setObjectName("patient_dialog");
  setWindowTitle(tr("Patient"));
  setMinimumWidth(480);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(24, 20, 24, 20);
  column->setSpacing(14);
  column->addWidget(makeLabel(tr("Patient"), "title"));
  auto* fields = new QFormLayout;
  fields->setHorizontalSpacing(16);
  fields->setVerticalSpacing(8);
  fields->setLabelAlignment(Qt::AlignLeft);
  form_ = std::make_unique<PatientForm>(*fields, "patient_", false);
  form_->show(document_.current().patient);
  column->addLayout(fields);
  auto* note = makeLabel(tr("Stages that read what changes are out of date afterwards."), "small");
  column->addWidget(note);
  problem_ = new QLabel;
  problem_->setObjectName("patient_problem");
  problem_->setWordWrap(true);
  problem_->setStyleSheet("color: " + colour::kDanger.name());
  problem_->hide();
  column->addWidget(problem_);
  auto* buttons = new QDialogButtonBox{QDialogButtonBox::Cancel | QDialogButtonBox::Ok};
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Change"));
  buttons->button(QDialogButtonBox::Ok)->setObjectName("patient_accept");
  buttons->button(QDialogButtonBox::Ok)->setProperty("role", "primary");
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &PatientDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

void PatientDialog::accept() {
  try {
    const Patient patient = form_->read();
    Case tried = document_.current();
    setPatient(tried, patient, dateToday());
    document_.edit(tr("Change patient"), [&](Case& c) { setPatient(c, patient, dateToday()); });
    QDialog::accept();
  } catch (const InputError& error) {
    problem_->setText(QString::fromUtf8(error.what()));
    problem_->show();
  }
}

}  // namespace sinew

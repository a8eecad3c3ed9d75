#include "app/widgets/shell/new_case_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "clinical/case/patient_edit.h"
#include "core/text.h"

namespace sinew {
namespace {

/// Nothing, or millimetres that a pixel of a radiograph may have.
std::optional<double> pixelSize_mm(const QLineEdit& edit) {
  const std::string text = edit.text().trimmed().toStdString();
  if (text.empty()) return {};
  const double value_mm = parseNumber(text, "new case", "pixel size [mm]");
  if (!(value_mm >= 0.01 && value_mm <= 5)) throw InputError{{"new case", "pixel size [mm]", "0.01 to 5", text}};
  return value_mm;
}

}  // namespace

NewCaseDialog::NewCaseDialog(QWidget* parent) : QDialog{parent} {
  setObjectName("new_case_dialog");
  setWindowTitle(tr("New case"));
  setMinimumWidth(560);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(24, 20, 24, 20);
  column->setSpacing(14);
  column->addWidget(makeLabel(tr("New case from radiographs"), "title"));
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(16);
  form->setVerticalSpacing(8);
  form->setLabelAlignment(Qt::AlignLeft);
  frontal_ = addPath(*form, "new_frontal", tr("Frontal radiograph"), false);
  lateral_ = addPath(*form, "new_lateral", tr("Lateral radiograph"), false);
  folder_ = addPath(*form, "new_folder", tr("Folder of the case"), true);
  spacing_mm_ = new QLineEdit;
  spacing_mm_->setObjectName("new_spacing");
  spacing_mm_->setPlaceholderText(tr("only for files without one"));
  form->addRow(tr("Pixel size [mm]"), spacing_mm_);
  patient_ = std::make_unique<PatientForm>(*form, "new_", true);
  column->addLayout(form);
  problem_ = new QLabel;
  problem_->setObjectName("new_problem");
  problem_->setWordWrap(true);
  problem_->setStyleSheet("color: " + colour::kDanger.name());
  column->addWidget(problem_);
  auto* buttons = new QDialogButtonBox{QDialogButtonBox::Cancel | QDialogButtonBox::Ok};
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Make case"));
  buttons->button(QDialogButtonBox::Ok)->setObjectName("new_accept");
  buttons->button(QDialogButtonBox::Ok)->setProperty("role", "primary");
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &NewCaseDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

QLineEdit* NewCaseDialog::addPath(QFormLayout& form, const QString& object_name, const QString& label,
                                  bool is_folder) {
  auto* edit = new QLineEdit;
  edit->setObjectName(object_name);
  auto* browse = makeButton(object_name + "_browse", tr("Browse …"), "", tr("Choose with a dialog"));
  connect(browse, &QPushButton::clicked, this, [this, edit, label, is_folder] {
    const auto path = is_folder
                          ? askForFolder(this, label)
                          : askForFile(this, label, tr("Radiographs (*.dcm *.tif *.tiff *.png);;All files (*)"));
    if (!path.empty()) edit->setText(QString::fromStdString(path.string()));
  });
  auto* row = new QHBoxLayout;
  row->addWidget(edit, 1);
  row->addWidget(browse);
  form.addRow(label, row);
  return edit;
}

NewCase NewCaseDialog::wanted() const {
  NewCase wanted;
  wanted.images = {frontal_->text().trimmed().toStdString(), lateral_->text().trimmed().toStdString()};
  if (wanted.images[0].empty()) throw InputError{{"new case", "frontal radiograph", "a file", "nothing"}};
  if (wanted.images[1].empty()) throw InputError{{"new case", "lateral radiograph", "a file", "nothing"}};
  wanted.declared_spacing_mm = pixelSize_mm(*spacing_mm_);
  wanted.patient = patient_->read();
  Case tried;
  setPatient(tried, wanted.patient, dateToday());  // what cannot be is said while the form is still open
  return wanted;
}

std::filesystem::path NewCaseDialog::folder() const {
  return folder_->text().trimmed().toStdString();
}

void NewCaseDialog::accept() {
  try {
    wanted();
    if (folder().empty()) throw InputError{{"new case", "folder", "a folder", "nothing"}};
    QDialog::accept();
  } catch (const InputError& error) {
    problem_->setText(QString::fromUtf8(error.what()));
  }
}

}  // namespace sinew

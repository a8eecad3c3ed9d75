#include "app/widgets/shell/new_case_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "core/text.h"

namespace sinew {
namespace {

std::optional<double> optionalNumber(const QLineEdit& edit, const char* field, double low, double high,
                                     double scale) {
  const std::string text = edit.text().trimmed().toStdString();
  if (text.empty()) return {};
  const double value = parseNumber(text, "new case", field);
  if (!(value >= low && value <= high))
    throw InputError{
        {"new case", field, figure(low, 2).toStdString() + " to " + figure(high, 0).toStdString(), text}};
  return value * scale;
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
  const auto field = [&](const QString& object_name, const QString& label, const QString& hint) {
    auto* edit = new QLineEdit;
    edit->setObjectName(object_name);
    edit->setPlaceholderText(hint);
    form->addRow(label, edit);
    return edit;
  };
  spacing_mm_ = field("new_spacing", tr("Pixel size [mm]"), tr("only for files without one"));
  name_ = field("new_name", tr("Patient"), tr("from the image"));
  id_ = field("new_id", tr("Patient id"), tr("from the image"));
  sex_ = new QComboBox;
  sex_->setObjectName("new_sex");
  sex_->addItems({tr("from the image"), "F", "M", "O"});
  form->addRow(tr("Sex"), sex_);
  birth_date_ = field("new_birth_date", tr("Birth date"), tr("YYYY-MM-DD, from the image"));
  height_cm_ = field("new_height", tr("Height [cm]"), {});
  mass_kg_ = field("new_mass", tr("Mass [kg]"), tr("scales the stop torque of the examination"));
  diagnosis_ = field("new_diagnosis", tr("Diagnosis"), {});
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
  wanted.declared_spacing_mm = optionalNumber(*spacing_mm_, "pixel size [mm]", 0.01, 5, 1);
  wanted.patient.name = name_->text().trimmed().toStdString();
  wanted.patient.id = id_->text().trimmed().toStdString();
  if (sex_->currentIndex() > 0) wanted.patient.sex = sex_->currentText().toStdString();
  wanted.patient.birth_date = birth_date_->text().trimmed().toStdString();
  wanted.patient.diagnosis = diagnosis_->text().trimmed().toStdString();
  wanted.patient.height_m = optionalNumber(*height_cm_, "height [cm]", 30, 250, 0.01);
  wanted.patient.mass_kg = optionalNumber(*mass_kg_, "mass [kg]", 2, 300, 1);
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

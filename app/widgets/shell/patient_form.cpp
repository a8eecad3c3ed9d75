#include "app/widgets/shell/patient_form.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>

#include "core/text.h"

namespace sinew {
namespace {

QString tr(const char* text) {
  return QObject::tr(text);
}

std::optional<double> optionalNumber(const QLineEdit& edit, const char* field) {
  const std::string text = edit.text().trimmed().toStdString();
  if (text.empty()) return {};
  return parseNumber(text, "patient", field);
}

/// As it was typed: 164.5, 54; nothing for what is not known.
QString numberText(const std::optional<double>& value, double scale) {
  return value ? QString::number(*value * scale, 'g', 6) : QString{};
}

}  // namespace

PatientForm::PatientForm(QFormLayout& form, const QString& prefix, bool from_image) {
  const QString image = from_image ? tr("from the image") : tr("not known");
  const auto field = [&](const char* object_name, const QString& label, const QString& hint) {
    auto* edit = new QLineEdit;
    edit->setObjectName(prefix + object_name);
    edit->setPlaceholderText(hint);
    form.addRow(label, edit);
    return edit;
  };
  name_ = field("name", tr("Patient"), image);
  id_ = field("id", tr("Patient id"), image);
  sex_ = new QComboBox;
  sex_->setObjectName(prefix + "sex");
  sex_->addItem(image, "");
  sex_->addItem(tr("Female"), "F");
  sex_->addItem(tr("Male"), "M");
  sex_->addItem(tr("Other"), "O");
  form.addRow(tr("Sex"), sex_);
  birth_date_ =
      field("birth_date", tr("Birth date"), from_image ? tr("YYYY-MM-DD, from the image") : tr("YYYY-MM-DD"));
  height_cm_ = field("height", tr("Height [cm]"), tr("for norms of lengths"));
  mass_kg_ = field("mass", tr("Mass [kg]"), tr("scales muscles and the stop torque of the examination"));
  diagnosis_ = field("diagnosis", tr("Diagnosis"), {});
}

void PatientForm::show(const Patient& p) {
  name_->setText(QString::fromStdString(p.name));
  id_->setText(QString::fromStdString(p.id));
  sex_->setCurrentIndex(std::max(0, sex_->findData(QString::fromStdString(p.sex))));
  birth_date_->setText(QString::fromStdString(p.birth_date));
  height_cm_->setText(numberText(p.height_m, 100));
  mass_kg_->setText(numberText(p.mass_kg, 1));
  diagnosis_->setText(QString::fromStdString(p.diagnosis));
}

Patient PatientForm::read() const {
  Patient p;
  p.name = name_->text().trimmed().toStdString();
  p.id = id_->text().trimmed().toStdString();
  p.sex = sex_->currentData().toString().toStdString();
  p.birth_date = birth_date_->text().trimmed().toStdString();
  p.height_m = optionalNumber(*height_cm_, "height [cm]");
  if (p.height_m) *p.height_m /= 100;
  p.mass_kg = optionalNumber(*mass_kg_, "mass [kg]");
  p.diagnosis = diagnosis_->text().trimmed().toStdString();
  return p;
}

}  // namespace sinew

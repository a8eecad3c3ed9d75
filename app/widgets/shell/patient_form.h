#pragma once
#include <QWidget>

#include "clinical/case/case.h"

class QComboBox;
class QFormLayout;
class QLineEdit;

namespace sinew {

/// The fields that state a patient: name, id, sex, birth date, height, mass, diagnosis. They join a form of somebody
/// else; what they mean and what is allowed says setPatient().
class PatientForm {
 public:
  /// Adds the fields to `form`; their object names begin with `prefix`. `from_image`: empty fields are filled from
  /// the image.
  PatientForm(QFormLayout& form, const QString& prefix, bool from_image);

  void show(const Patient& patient);
  /// @throws InputError if height or mass is no number.
  Patient read() const;

 private:
  QLineEdit *name_, *id_, *birth_date_, *height_cm_, *mass_kg_, *diagnosis_;
  QComboBox* sex_;
};

}  // namespace sinew

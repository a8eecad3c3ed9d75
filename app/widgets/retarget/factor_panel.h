#pragma once
#include <QWidget>
#include <string>
#include <vector>

#include "app/model/retarget/retarget_design.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QTableWidget;

namespace sinew {

struct Musculature;

/// Masses of the parts of the body, and strengths of muscles and groups.
class FactorPanel : public QWidget {
  Q_OBJECT
 public:
  explicit FactorPanel(DesignDocument& document, QWidget* parent = nullptr);
  /// Names that a strength may be given to.
  void setMusculature(const Musculature& musculature);
  /// Whole mass of the body that is shown, and of the reference; NaN: not known.
  void showMass(double mass_kg, double reference_kg);

 private:
  struct MassRow {
    std::string part;
    QComboBox* rule;
    QDoubleSpinBox* value;
  };
  QWidget* makeMasses();
  QWidget* makeStrengths();
  void setMass(std::size_t row);
  void addStrength();
  void refresh();
  void refreshStrengths();

  DesignDocument& document_;
  std::vector<MassRow> masses_;
  QLabel* mass_;
  QComboBox* name_;
  QTableWidget* strengths_;
  std::vector<std::string> shown_;  ///< names of the rows
};

}  // namespace sinew

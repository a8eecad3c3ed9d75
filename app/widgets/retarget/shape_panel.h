#pragma once
#include <QWidget>
#include <vector>

#include "app/model/retarget/retarget_design.h"
#include "app/model/retarget/shape_form.h"

class QCheckBox;
class QVBoxLayout;

namespace sinew {

class ParameterRow;

/// Every shape parameter with slider and field, part by part; both sides at once or each for itself.
class ShapePanel : public QWidget {
  Q_OBJECT
 public:
  explicit ShapePanel(DesignDocument& document, QWidget* parent = nullptr);
  bool sidesLinked() const;

 private:
  struct Row {
    ShapeField field;
    int side;
    ParameterRow* row;
  };
  void addRow(const ShapeField& field, int side, QVBoxLayout& column);
  void linkSides(bool linked);
  void refresh();

  DesignDocument& document_;
  QCheckBox* linked_;
  std::vector<Row> rows_;
};

}  // namespace sinew

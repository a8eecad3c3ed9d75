#pragma once
#include <QWidget>

#include "app/widgets/views/radiograph_view.h"

class QComboBox;
class QLabel;
class QSpinBox;
class QToolButton;

namespace sinew {

class Workspace;

/// A radiograph of the open case with its tools: window presets and numbers, inversion, fit, 1:1, and a line that
/// reads the pixel under the mouse.
class RadiographPane : public QWidget {
  Q_OBJECT
 public:
  /// `view`: the one shown first; with more than two radiographs the person chooses.
  /// `full_tools`: window centre and width as numbers, presets; otherwise only fit, 1:1 and inversion.
  RadiographPane(Workspace& workspace, int view, bool full_tools, QWidget* parent = nullptr);

  /// Shows the calibration phantom's images instead of the patient's.
  void setPhantom(bool on);
  /// Shows another view of the case.
  void setViewIndex(int view);

  RadiographView& view() { return *view_; }
  int viewIndex() const { return index_; }
  /// Shows the case's image; says in its place why there is none.
  void refresh();

 signals:
  /// Another view was chosen: what is drawn over it belongs to the old one.
  void viewChanged();

 private:
  void refreshTitle();
  int slot() const;
  void readPixel(const QPointF& uv_px);
  void showWindow();
  void setWindow(double center, double width);
  void applyPreset(int index);

  Workspace& workspace_;
  const int place_;  ///< 0 left, 1 right
  int index_;        ///< of the view
  bool phantom_ = false;
  RadiographView* view_;
  QLabel *title_, *readout_;
  QSpinBox *center_ = nullptr, *width_ = nullptr;
  QComboBox* chooser_;  ///< of the view; with more than two
  QComboBox* presets_ = nullptr;
  QToolButton* invert_;
};

/// Grey values that `low` and `high` (0-1) of all pixels stay below: a window that ignores extremes.
std::pair<double, double> greyRange(const Radiograph& radiograph, double low, double high);

}  // namespace sinew

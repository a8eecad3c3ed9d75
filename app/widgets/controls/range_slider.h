#pragma once
#include <QAbstractSlider>
#include <optional>
#include <utility>

namespace sinew {

/// A slider that shows more than a value: the whole range (a joint's envelope), a band in it (the norm) and the part
/// that is free at present (what muscles leave), with words and figures at its ends. Values are tenths of the shown
/// unit: keys, wheel and accessibility are QAbstractSlider's. The wheel only turns it while it has the focus.
class RangeSlider : public QAbstractSlider {
  Q_OBJECT
 public:
  explicit RangeSlider(QWidget* parent = nullptr);

  void setEnds(const QString& low, const QString& high);
  void setBand(int low, int high);
  /// nullopt: not known yet. first > second: nothing is free.
  void setFree(std::optional<std::pair<int, int>> interval);

  QSize sizeHint() const override { return {220, 36}; }
  QSize minimumSizeHint() const override { return {140, 36}; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  double xOf(double value) const;
  int valueAt(double x) const;

  QString low_text_, high_text_;
  int band_low_ = 0, band_high_ = 0;
  std::optional<std::pair<int, int>> free_;
};

}  // namespace sinew

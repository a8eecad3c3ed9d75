#pragma once
#include <QWidget>
#include <array>

namespace sinew {

/// A range of angles on a line, with ends to take hold of: drag an end, or the piece between to move both. Other
/// ranges may be shown above and below to compare with. Left and right keys move the end that has the focus ring
/// (Up and Down choose it).
class RangeBar : public QWidget {
  Q_OBJECT
 public:
  struct Range {
    double low_deg = 0, high_deg = 0;
    friend bool operator==(const Range&, const Range&) = default;
  };
  explicit RangeBar(const QString& object_name, QWidget* parent = nullptr);

  void setScale(double low_deg, double high_deg);
  /// Thin lines: how it was before, and what was reached (nullptr: not known).
  void setBefore(const Range& range);
  void setReached(const Range* range);
  void setRange(const Range& range);
  const Range& range() const { return range_; }

  QSize sizeHint() const override { return {420, 80}; }
  QSize minimumSizeHint() const override { return {220, 80}; }

 signals:
  void dragged(double low_deg, double high_deg);
  void settled(double low_deg, double high_deg);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent*) override { update(); }
  void focusOutEvent(QFocusEvent*) override { update(); }

 private:
  enum class Grip { None, Low, High, Both };
  double xOf(double deg) const;
  double degAt(double x) const;
  Grip gripAt(double x) const;
  void move(Grip grip, double by_deg);

  double low_deg_ = -180, high_deg_ = 180;
  Range range_, before_, reached_, pressed_;
  bool has_reached_ = false;
  Grip held_ = Grip::None, key_grip_ = Grip::High;
  double press_deg_ = 0;
};

}  // namespace sinew

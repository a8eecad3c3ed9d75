#pragma once
#include <QColor>
#include <QString>
#include <QWidget>
#include <utility>
#include <vector>

namespace sinew {

struct PlotCurve {
  QString name;
  std::vector<std::pair<double, double>> points;
  QColor color;
  bool dashed = false;
};

/// A vertical or horizontal line with a label.
struct PlotMark {
  QString name;
  double value = 0;
  QColor color;
  bool horizontal = false;
};

/// A small x-y plot: curves with direct labels, marks, round ticks; readable in grey because lines differ in dash.
class CurvePlot : public QWidget {
  Q_OBJECT
 public:
  explicit CurvePlot(QWidget* parent = nullptr);
  void setAxes(const QString& x_title, const QString& y_title);
  /// Shaded range of x (a norm); nothing if low >= high.
  void setBand(double low, double high, const QString& name);
  void setCurves(std::vector<PlotCurve> curves, std::vector<PlotMark> marks, const QString& placeholder);
  /// y beyond this is cut off; 0 = no limit.
  void setHighest(double y) { highest_ = y; }
  /// Whether y always shows zero; a length says more without.
  void setFromZero(bool from_zero) { from_zero_ = from_zero; }

  QSize sizeHint() const override { return {360, 260}; }
  QSize minimumSizeHint() const override { return {240, 180}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  struct Range {
    double low, high;
  };
  Range rangeX() const;
  Range rangeY() const;

  QString x_title_, y_title_, placeholder_, band_name_;
  double band_low_ = 0, band_high_ = 0, highest_ = 0;
  bool from_zero_ = true;
  std::vector<PlotCurve> curves_;
  std::vector<PlotMark> marks_;
};

/// A round step (1, 2 or 5 times a power of ten) that divides `span` into at most `most` parts.
double roundStep(double span, int most);

}  // namespace sinew

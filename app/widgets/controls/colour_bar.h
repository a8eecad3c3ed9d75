#pragma once
#include <QWidget>
#include <functional>

#include "app/scene/palette.h"

namespace sinew {

/// What the colours of the view beside it mean: a strip with its title and the figures at its ends and between, on a
/// dark or a light ground.
class ColourBar : public QWidget {
  Q_OBJECT
 public:
  enum class Ground { Dark, Light };
  explicit ColourBar(Ground ground, QWidget* parent = nullptr);

  /// `colour_of` maps [0, 1]. `open_ended`: values beyond are drawn in the end's colour, and the end says so.
  void setScale(const QString& title, double low, double high, int decimals, bool open_low, bool open_high,
                std::function<Rgb(double)> colour_of);
  /// Words alone, where colours are names.
  void setWords(const QString& words);
  const QString& title() const { return title_; }

  QSize sizeHint() const override { return {260, 44}; }
  QSize minimumSizeHint() const override { return {180, 44}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  Ground ground_;
  QString title_;
  double low_ = 0, high_ = 1;
  int decimals_ = 0;
  bool open_low_ = false, open_high_ = false;
  std::function<Rgb(double)> colour_of_;
};

}  // namespace sinew

#pragma once
#include <QImage>
#include <QWidget>
#include <memory>
#include <optional>

#include "app/model/explorer/latest_job.h"
#include "app/model/retarget/characters.h"
#include "app/scene/lineup.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace sinew {

/// A picture with names below, scaled to its room.
class LineupLabel : public QWidget {
  Q_OBJECT
 public:
  explicit LineupLabel(QWidget* parent = nullptr);
  void setPicture(const QImage& picture);

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  QImage picture_;
};

/// The reference, the paper's characters and the present body side by side on one ground.
class CharactersView : public QWidget {
  Q_OBJECT
 public:
  explicit CharactersView(QWidget* parent = nullptr);

  /// Begins with the characters if that has not been done yet.
  void open(std::shared_ptr<const RetargetReference> reference, const std::filesystem::path& resource_dir);
  /// Shown at the end of the line if the person asks for it. nullptr: there is none.
  void setPresent(std::shared_ptr<const Model> model, const QString& name);
  const QImage& picture() const { return picture_; }  ///< null until it is drawn
  bool isBusy() const { return study_.isBusy() || drawing_.isBusy(); }

 signals:
  void problem(const QString& message);
  void notice(const QString& message);

 private:
  void draw();
  void savePicture();
  void showBusy(const QString& words, double fraction);

  CharacterStudy study_;
  std::shared_ptr<const Model> present_;
  QString present_name_;
  QComboBox* look_;
  QCheckBox *muscles_, *with_present_;
  QPushButton *save_, *cancel_;
  QProgressBar* progress_;
  QLabel* words_;
  LineupLabel* label_;
  QImage picture_;
  LatestJob drawing_;  ///< last: its thread ends before what it uses goes
};

/// Names, heights and the ground added to a line-up.
QImage captioned(const Lineup& lineup, const std::vector<QString>& names);

}  // namespace sinew

#pragma once
#include <map>
#include <string>
#include <vector>

#include "app/widgets/stages/stage_page.h"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace sinew {

class CurvePlot;
struct ClinicalTest;

/// The examination by test and side: what was measured, what the model gives in the same test before and after its
/// muscle lengths were solved, what remains and why, which muscles limit; every length factor with its interval.
class ExamPage : public StagePage {
  Q_OBJECT
 public:
  explicit ExamPage(Workspace& workspace);

 protected:
  void refresh() override;

 private:
  struct Line {
    QLineEdit *measured, *stop, *note;
    QLabel *before, *after, *residual, *limiting;
  };
  void buildForm();
  QWidget* makeTestCard(const ClinicalTest& test);
  Line makeLine(const ClinicalTest& test, char side, QGridLayout& grid, int row);
  void enterStop(const ClinicalTest& test, char side, const QString& text);
  void enterMeasured(const ClinicalTest& test, char side, const QString& text);
  void refreshFacts(const ClinicalTest& test, QLabel& label);
  void refreshLine(const ClinicalTest& test, char side, Line& line);
  void refreshPlot();

  QVBoxLayout* form_;
  QLineEdit *examiner_, *date_;
  QComboBox *plot_test_, *plot_side_;
  CurvePlot* plot_;
  QLabel *verdict_, *factors_;
  QCheckBox* leave_in_norm_;
  std::map<std::string, QLabel*> facts_;  ///< by test: norm, stop, limits
  std::map<std::pair<std::string, char>, Line> lines_;
  bool built_ = false;
};

}  // namespace sinew

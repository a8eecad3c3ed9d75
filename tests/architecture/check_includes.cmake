# Dependencies point one way. Each row: folder | what its files must not include | files that may, for a stated reason.
set(rules
  "core|\"(imaging|clinical|app)/|<(Q[A-Z]|vtk|opencv2|dcmtk)"
  "imaging|\"(clinical|app)/|<(Q[A-Z]|vtk)"
  "clinical|\"app/|<(Q[A-Z]|vtk|opencv2|dcmtk)"
  "app/model|\"app/(scene|widgets|cli|report)/|<(QWidget|QtWidgets|vtk|opencv2|dcmtk)"
  "app/mesh|\"app/(model|scene|widgets|cli|report)/|<(Q[A-Z]|opencv2|dcmtk)"
  "app/scene|\"app/(model|widgets|cli|report)/|<(Q[A-Z]|opencv2|dcmtk)"
  "app/report|\"app/(widgets|cli)/|<(QWidget|QtWidgets|opencv2|dcmtk)"
  "app/widgets|\"app/cli/|<(opencv2|dcmtk)"
  "app/cli|<(QWidget|QtWidgets|vtk|opencv2|dcmtk)")
# Public headers show std and Eigen only; what a solver or a file needs stays in .cpp and *_residuals.h, *_json.h.
set(hidden "<(ceres|nlohmann|opencv2|dcmtk|openssl|pugixml)")

set(bad "")
foreach(rule ${rules})
  string(REGEX MATCH "^([^|]*)\\|(.*)$" _ "${rule}")
  set(folder ${CMAKE_MATCH_1})
  set(pattern ${CMAKE_MATCH_2})
  file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp)
  foreach(file ${files})
    file(STRINGS ${file} hits REGEX "^ *#include *(${pattern})")
    if(hits)
      string(APPEND bad "${file}: ${hits}\n")
    endif()
  endforeach()
endforeach()

file(GLOB_RECURSE headers ${ROOT}/core/*.h ${ROOT}/imaging/*.h ${ROOT}/clinical/*.h)
foreach(file ${headers})
  if(NOT file MATCHES "_(residuals|json|internal)\\.h$")
    file(STRINGS ${file} hits REGEX "^ *#include *(${hidden})")
    if(hits)
      string(APPEND bad "${file}: ${hits}\n")
    endif()
  endif()
endforeach()
if(bad)
  message(FATAL_ERROR "Includes against the direction of the house:\n${bad}")
endif()

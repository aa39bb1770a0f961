# SPDX-License-Identifier: BSD-3-Clause
# OpenCV's core and imgproc from the packages libopencv-core-dev and libopencv-imgproc-dev. OpenCV's
# own config file stands in libopencv-dev, which would pull in video, GUI and geo libraries of 1 GB.
find_path(OpenCVImgproc_INCLUDE_DIR opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
find_library(OpenCVImgproc_CORE opencv_core)
find_library(OpenCVImgproc_IMGPROC opencv_imgproc)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVImgproc DEFAULT_MSG OpenCVImgproc_IMGPROC
                                  OpenCVImgproc_CORE OpenCVImgproc_INCLUDE_DIR)
if(OpenCVImgproc_FOUND AND NOT TARGET OpenCV::imgproc)
  add_library(OpenCV::imgproc INTERFACE IMPORTED)
  set_target_properties(OpenCV::imgproc PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${OpenCVImgproc_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES "${OpenCVImgproc_IMGPROC};${OpenCVImgproc_CORE}")
endif()

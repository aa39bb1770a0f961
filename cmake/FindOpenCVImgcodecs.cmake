# SPDX-License-Identifier: BSD-3-Clause
# OpenCV's imgcodecs from the package libopencv-imgcodecs-dev: picture files, for the digitiser alone.
find_package(OpenCVImgproc REQUIRED MODULE)
find_path(OpenCVImgcodecs_INCLUDE_DIR opencv2/imgcodecs.hpp PATH_SUFFIXES opencv4)
find_library(OpenCVImgcodecs_LIBRARY opencv_imgcodecs)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVImgcodecs DEFAULT_MSG OpenCVImgcodecs_LIBRARY
                                  OpenCVImgcodecs_INCLUDE_DIR)
if(OpenCVImgcodecs_FOUND AND NOT TARGET OpenCV::imgcodecs)
  add_library(OpenCV::imgcodecs INTERFACE IMPORTED)
  set_target_properties(OpenCV::imgcodecs PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${OpenCVImgcodecs_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES "${OpenCVImgcodecs_LIBRARY};OpenCV::imgproc")
endif()

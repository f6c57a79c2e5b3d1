# SPDX-License-Identifier: Apache-2.0
"""The wheel: CMake builds the extension and the modules that it opens, which lie beside it."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TOP = Path(__file__).resolve().parent.parent
LIBRARIES = ["_skyfit*.so", "skyfit_dem_module.so", "skyfit_image_module.so",
             "skyfit_netcdf_module.so", "skyfit_render_module.so"]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = TOP / "build" / "wheel"
        options = ["-DSKYFIT_PYTHON_PACKAGE=ON", "-DSKYFIT_TESTS=OFF", "-DSKYFIT_NOTEBOOKS=OFF"]
        options += [f"-DSKYFIT_PYTHON_PROGRAM={sys.executable}", "-DCMAKE_BUILD_TYPE=Release"]
        subprocess.run(["cmake", "-G", "Ninja", "-S", TOP, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "skyfit_python"], check=True)
        folder = Path(self.get_ext_fullpath(extension.name)).parent
        folder.mkdir(parents=True, exist_ok=True)
        for pattern in LIBRARIES:
            found = [*build.glob(pattern), *(build / "python" / "skyfit").glob(pattern)]
            if len(found) != 1:
                raise FileNotFoundError(f"{build}: {pattern}: expected one file, found {found}")
            shutil.copy2(found[0], folder)


def version():
    """That of project() in CMakeLists.txt, the one place of it."""
    return re.search(r"project\(skyfit VERSION (\S+)", (TOP / "CMakeLists.txt").read_text())[1]


setup(
    version=version(),
    ext_modules=[Extension("skyfit._skyfit", [])],
    cmdclass={"build_ext": CMakeBuild},
)

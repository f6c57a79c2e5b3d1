# SPDX-License-Identifier: Apache-2.0
"""The NetCDF files of skyfit open in xarray, its .npz in NumPy, and both hold the numbers of the CSV. Usage: xarray_test.py SKYFIT"""
import csv
import io
import pathlib
import subprocess
import sys
import tempfile

import numpy
import xarray

skyfit = sys.argv[1]
folder = tempfile.TemporaryDirectory()
here = pathlib.Path(folder.name)


def run(*arguments):
    return subprocess.run([skyfit, *arguments], check=True, capture_output=True, text=True).stdout


sky = ["sky", "--preset", "earth-clear", "--sun-zenith-deg", "30,60", "--view-zenith-deg", "0:80:40",
       "--azimuth-deg", "0,90,180"]
for options, column, axes in [
    ([*sky, "--wavelength-nm", "450,550"], "radiance_per_irradiance_sr",
     ("altitude", "sun_zenith", "view_zenith", "relative_azimuth", "wavelength")),
    ([*sky, "--wavelength-nm", "450,550", "--stokes"], "degree_of_linear_polarisation",
     ("altitude", "sun_zenith", "view_zenith", "relative_azimuth", "wavelength")),
    (sky, "luminance_cd_m2", ("altitude", "sun_zenith", "view_zenith", "relative_azimuth")),
    (["sky", "--preset", "earth-clear", "--sun-zenith-deg", "30,60", "--irradiance", "--wavelength-nm", "450,550"],
     "diffuse_horizontal_w_m2_nm", ("altitude", "sun_zenith", "wavelength")),
]:
    table = list(csv.DictReader(io.StringIO(run(*options))))
    assert run(*options, "--netcdf", str(here / "sky.nc")) == ""
    data = xarray.open_dataset(here / "sky.nc")
    assert data.attrs["Conventions"] == "CF-1.8"
    assert data[column].dims == axes, data[column].dims
    assert data[column].attrs["units"]
    assert data.attrs["history"].startswith("skyfit sky --preset earth-clear"), data.attrs["history"]
    assert len(table) == data[column].size
    names = {"altitude": "altitude_m", "wavelength": "wavelength_nm"}
    for row in table:
        place = {axis: float(row[names.get(axis, axis + "_deg")]) for axis in axes}
        numpy.testing.assert_allclose(float(data[column].sel(place)), float(row[column]), rtol=1e-8)
    assert run(*options, "--npz", str(here / "sky.npz")) == ""
    with numpy.load(here / "sky.npz") as arrays:
        assert set(arrays) == set(data.variables), set(arrays)
        for name in arrays:
            assert arrays[name].dtype == numpy.float64
            numpy.testing.assert_array_equal(arrays[name], data[name].values)
    data.close()

piped = subprocess.run([skyfit, *sky, "--npz", "-.npz"], check=True, capture_output=True).stdout
with numpy.load(io.BytesIO(piped)) as arrays:
    assert arrays["luminance_cd_m2"].shape == (1, 2, 3, 3)

run("fit", "--reference", "cie:12", "--sun-zenith-deg", "30,60", "--starts", "1", "--lobes", "1", "--free",
    "mie.scattering,mie.phase.g", "--out", str(here / "fitted"), "--netcdf", str(here / "fit.nc"))
fit = xarray.open_dataset(here / "fit.nc")
one = dict(covariance_parameter="mie.scattering", covariance_parameter_2="mie.scattering")
numpy.testing.assert_allclose(float(fit.parameter_sigma.sel(parameter="mie.scattering")),
                              float(fit.covariance.sel(one)) ** 0.5, rtol=1e-9)
assert fit.sizes["scan"] == 2
assert {"sun_zenith", "view_zenith", "relative_azimuth"} <= set(fit.model.coords), fit.model.coords
assert "units" not in fit.parameter_value.attrs
used = fit.weight > 0
misfit = float((numpy.log(fit.model / fit.reference_value)[used]
                .groupby(fit.sample_scan[used]).map(lambda scan: (scan - scan.mean()) ** 2).mean()) ** 0.5)
numpy.testing.assert_allclose(100 * misfit, float((fit.rms_log**2).mean() ** 0.5), rtol=0.01)

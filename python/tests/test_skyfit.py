# SPDX-License-Identifier: Apache-2.0
"""The package gives the numbers of the program, in the shapes of NumPy, and its one-line errors."""

import copy
import csv
import gc
import io
import json
import os
import pickle
import re
import signal
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import skyfit

PROGRAM = os.environ["SKYFIT_PROGRAM"]
EXAMPLES = Path(os.environ["SKYFIT_SOURCE_DIR"]) / "data_refs" / "examples"
SUNS, VIEWS, NM = [10.0, 75.0], [0.0, 40.0, 85.0], [450.0, 550.0]


def run(*arguments):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True
    ).stdout


def columns(text):
    rows = list(csv.reader(io.StringIO(text)))
    return {name: np.array(values) for name, *values in zip(*rows)}


def printed(values):
    """As the program prints: 9 digits, nothing for NaN."""
    return ["" if np.isnan(value) else f"{value:.9g}" for value in np.ravel(values)]


def of_program(*arguments):
    return columns(
        run("sky", "--preset", "earth-clear", "--sun-zenith-deg", "10,75", *arguments)
    )


VIEW_OPTIONS = ("--view-zenith-deg", "0,40,85", "--azimuth-deg", "30")


def grid(**options):
    return skyfit.sky("earth-clear", np.array(SUNS)[:, None], VIEWS, 30, **options)


def test_luminance_is_that_of_the_program():
    sky = grid()
    assert sky["luminance_cd_m2"].shape == (2, 3)
    assert printed(sky["luminance_cd_m2"]) == list(of_program(*VIEW_OPTIONS)["luminance_cd_m2"])


def test_radiance_is_that_of_the_program():
    theirs = of_program(*VIEW_OPTIONS, "--wavelength-nm", "450,550")
    sky = grid(wavelength_nm=NM)
    assert sky["radiance_per_irradiance_sr"].shape == (2, 3, 2)
    assert printed(sky["radiance_per_irradiance_sr"]) == list(theirs["radiance_per_irradiance_sr"])


def test_refracted_radiance_is_that_of_the_program():
    theirs = of_program(*VIEW_OPTIONS, "--wavelength-nm", "450", "--refraction")
    sky = grid(wavelength_nm=450, refraction=True)
    assert printed(sky["radiance_per_irradiance_sr"]) == list(theirs["radiance_per_irradiance_sr"])
    assert printed(sky["radiance_per_irradiance_sr"]) != printed(
        grid(wavelength_nm=450)["radiance_per_irradiance_sr"]
    )


def test_polarisation_is_that_of_the_program():
    theirs = of_program(*VIEW_OPTIONS, "--wavelength-nm", "450,550", "--stokes")
    sky = grid(wavelength_nm=NM, stokes=True)
    assert len(sky) == 5
    for name, values in sky.items():
        assert printed(values) == list(theirs[name]), name


@pytest.mark.parametrize("nm", [None, NM])
def test_irradiance_is_that_of_the_program(nm):
    spectral = ["--wavelength-nm", "450,550"] if nm else []
    theirs = of_program("--irradiance", *spectral)
    ours = skyfit.irradiance("earth-clear", SUNS, wavelength_nm=nm)
    assert len(ours) == 4
    for name, values in ours.items():
        assert values.shape == ((2, 2) if nm else (2,))
        assert printed(values) == list(theirs[name]), name


def test_results_do_not_depend_on_threads():
    assert np.array_equal(grid(threads=1)["luminance_cd_m2"], grid(threads=2)["luminance_cd_m2"])


def test_one_wavelength_has_no_dimension_and_the_values_of_the_list():
    one = skyfit.sky("earth-clear", 75, 40, wavelength_nm=450)["radiance_per_irradiance_sr"]
    two = skyfit.sky("earth-clear", 75, 40, wavelength_nm=[450])["radiance_per_irradiance_sr"]
    assert one.shape == () and two.shape == (1,)
    assert one == two[0]


def test_derivatives_are_those_of_differences():
    names = ["mie.scattering", "ground.albedo"]
    points = dict(sun_zenith_deg=60, view_zenith_deg=VIEWS, wavelength_nm=NM)
    exact = skyfit.sky("earth-clear", **points, derivatives=names)["d_radiance_per_irradiance_sr"]
    assert exact.shape == (2, 3, 2)
    preset = skyfit.Preset("earth-clear")
    for k, name in enumerate(names):
        step = 1e-3 * preset[name]
        sides = []
        for sign in (1, -1):
            moved = preset.copy()
            moved[name] += sign * step
            sides.append(skyfit.sky(moved, **points)["radiance_per_irradiance_sr"])
        difference = (sides[0] - sides[1]) / (2 * step)
        central = 1e-5  # the third derivative times the step squared
        np.testing.assert_allclose(exact[k], difference, rtol=central)


def test_irradiance_derivatives_are_those_of_differences():
    preset, name = skyfit.Preset("earth-clear"), "ground.albedo"
    ours = skyfit.irradiance(preset, [[10], [75]], [0, 2000], NM, derivatives=name)
    exact = ours["d_global_horizontal_w_m2_nm"]
    assert exact.shape == (1, 2, 2, 2)
    step, sides = 1e-3, []
    for sign in (1, -1):
        moved = preset.copy()
        moved[name] += sign * step
        at = skyfit.irradiance(moved, [[10], [75]], [0, 2000], NM)
        sides.append(at["global_horizontal_w_m2_nm"])
    np.testing.assert_allclose(exact[0], (sides[0] - sides[1]) / (2 * step), rtol=1e-5)


def test_arrays_become_xarray():
    xarray = pytest.importorskip("xarray")
    data = grid(wavelength_nm=NM, derivatives=["mie.scattering"]).to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert data["radiance_per_irradiance_sr"].dims == ("point_0", "point_1", "wavelength_nm")
    assert list(data["parameter"].values) == ["mie.scattering"]
    assert list(data["sun_zenith_deg"].values[:, 0]) == SUNS


def test_preset_round_trips():
    preset = skyfit.Preset("earth-clear")
    preset["mie.scattering"] = 1.25e-5
    assert preset["mie.scattering"] == 1.25e-5
    for other in (
        skyfit.Preset.from_json(preset.to_json()),
        skyfit.Preset.from_json(preset.to_dict()),
        pickle.loads(pickle.dumps(preset)),
        copy.deepcopy(preset),
    ):
        assert type(other) is skyfit.Preset
        assert other.to_json() == preset.to_json()


def test_preset_files_are_those_of_the_program(tmp_path):
    preset = skyfit.Preset("earth-clear")
    preset["mie.scattering"] = 1.25e-5
    preset.save(tmp_path / "hazy.json")
    assert skyfit.Preset(tmp_path / "hazy.json").to_json() == preset.to_json()
    theirs = columns(
        run(
            "sky", "--preset", tmp_path / "hazy.json",
            "--sun-zenith-deg", 30, "--view-zenith-deg", 60,
        )  # fmt: skip
    )
    ours = skyfit.sky(preset, 30, 60)
    assert printed(ours["luminance_cd_m2"]) == list(theirs["luminance_cd_m2"])


def test_preset_lists_its_parameters():
    rows = skyfit.Preset("earth-clear").parameters()
    assert rows["mie.scattering"]["unit"] == "1/m"
    assert rows["mie.scattering"]["value"] == skyfit.Preset("earth-clear")["mie.scattering"]


def test_copies_do_not_share_values():
    preset = skyfit.Preset("earth-clear")
    before = preset["ground.albedo"]
    preset.copy()["ground.albedo"] = 0.9
    assert preset["ground.albedo"] == before


def test_a_refused_value_leaves_the_preset_as_it_was():
    preset = skyfit.Preset("earth-clear")
    before = preset.to_json()
    with pytest.raises(ValueError, match="albedo"):
        preset["ground.albedo"] = -1
    assert preset.to_json() == before


MASKED = np.ma.array([30.0, 60.0], mask=[False, True])


@pytest.mark.parametrize(
    "call, expected",
    [
        (lambda: skyfit.Preset("nowhere"), "none of the shipped presets"),
        (lambda: skyfit.Preset("earth-clear")["mie.size"], "mie"),
        (lambda: skyfit.sky("earth-clear", 200, 0), "sun_zenith_deg = 200: expected"),
        (lambda: skyfit.sky("earth-clear", 10, np.nan), "view_zenith_deg = nan: expected"),
        (lambda: skyfit.sky("earth-clear", 10, 0, wavelength_nm=5), "wavelength_nm = 5"),
        (lambda: skyfit.sky("earth-clear", 10, 0, model="guess"), "guess"),
        (lambda: skyfit.sky("earth-clear", 10, 0, derivatives="moon.size"), "moon.size"),
        (lambda: skyfit.sky("earth-clear", [1, 2], [1, 2, 3]), "broadcast"),
        (lambda: skyfit.fit("cie:12", lobe=1), r"fit\(\): lobe: expected one of the options"),
        (lambda: skyfit.fit("cie:12", lobes=7), "lobes = 7"),
        (lambda: skyfit.fit("cie:12", threads=0), "threads"),
        (lambda: skyfit.fit("cie:12", lobes=True), "lobes: expected a value"),
        (lambda: skyfit.fit("cie:12", no_priors=3), "no_priors: expected True or False"),
        (lambda: skyfit.fit(skyfit.read("cie:12"), sampling="tregenza"), "option of read"),
        (lambda: skyfit.fit("cie:99"), "cie:99"),
        (lambda: skyfit.fit(), "a reference, irradiance or both"),
        (lambda: skyfit.fit("cie:12", irradiance="direct=1lx"), "the sun is not known"),
        (lambda: skyfit.read_irradiances("direct=800"), "no unit"),
        (lambda: skyfit.render("earth-clear", out="frame.png"), "save"),
        (lambda: skyfit.render("earth-clear", size=(0, 10)), "0x10"),
        (lambda: skyfit.render("earth-clear", view="attic"), "attic"),
        (lambda: skyfit.sky({"a": 1}, 30, 20), "preset: .* got dict"),
        (lambda: skyfit.sky("earth-clear", MASKED, 20), "sun_zenith_deg: .* masked"),
        (lambda: skyfit.sky("earth-clear", "high", 20), "sun_zenith_deg: expected a number"),
        (lambda: skyfit.sky("earth-clear", 30, 20, wavelength_nm=[]), "wavelength_nm: .* one"),
        (lambda: skyfit.irradiance("earth-clear", 30, wavelength_nm=[]), "wavelength_nm: .* one"),
        (lambda: skyfit.sky("earth-clear", 30, 20, threads=0), "threads: .* 1 to 1024"),
        (lambda: skyfit.sky("earth-clear", 30, 20, threads=1.5), "threads: .* 1 to 1024"),
        (lambda: skyfit.sky("earth-clear", 30, 20, scalar="no"), "scalar: expected True or False"),
        (lambda: skyfit.sky("earth-clear", 30, 20, stokes="no"), "stokes: expected True or False"),
        (lambda: reference_of(MASKED), "value: .* masked"),
        (lambda: reference_of([1.0, 2.0], scan=[0, 0.5]), "scan: expected whole numbers"),
        (lambda: reference_of([1.0, 2.0], scan=[0, np.nan]), "scan = nan: .* 0 to"),
        (lambda: skyfit.fit("cie:12", starts=object()), "starts: expected numbers"),
    ],
)
def test_errors_are_one_line_that_names_the_value(call, expected):
    with pytest.raises(ValueError, match=expected) as error:
        call()
    assert "\n" not in str(error.value)


def reference_of(value, **options):
    return skyfit.reference(value, 30, [10, 20], 0, quantity="luminance", **options)


def test_no_points_have_no_derivatives_of_each_parameter():
    sky = skyfit.sky("earth-clear", [], 20, derivatives=["mie.scattering"])
    assert sky["d_luminance_cd_m2"].shape == (1, 0)


def test_options_take_what_numpy_and_python_count_with(small_fit):
    again = skyfit.fit(
        "cie:12",
        free={"mie.scattering"},
        lobes=np.int64(1),
        starts=np.int32(1),
        sun_zenith_deg=range(20, 61, 40),
    )
    assert without_time(again.report_dict) == without_time(small_fit.report_dict)


FIT = dict(free=["mie.scattering"], lobes=1, starts=1, sun_zenith_deg=[20, 60])


def without_time(report):
    if isinstance(report, dict):
        return {k: without_time(v) for k, v in report.items() if k != "wall_seconds"}
    return [without_time(one) for one in report] if isinstance(report, list) else report


@pytest.fixture(scope="module")
def small_fit():
    return skyfit.fit("cie:12", **FIT)


def test_fit_is_that_of_the_program(small_fit, tmp_path):
    text = run(
        "fit", "--reference", "cie:12", "--free", "mie.scattering", "--lobes", 1, "--starts", 1,
        "--sun-zenith-deg", "20,60", "--out", tmp_path / "fit", "--json",
    )  # fmt: skip
    assert without_time(small_fit.report_dict) == without_time(json.loads(text))
    ours, theirs = (
        json.loads(one)
        for one in (small_fit.preset.to_json(), (tmp_path / "fit" / "preset.json").read_text())
    )
    assert without_time(ours) == without_time(theirs)


def test_fit_gives_values_with_their_errors(small_fit):
    assert list(small_fit.parameters) == ["mie.scattering"]
    assert small_fit.covariance.shape == (1, 1)
    variance = small_fit.sigma["mie.scattering"] ** 2
    assert small_fit.covariance[0, 0] == pytest.approx(variance, rel=1e-12)
    assert small_fit.preset["mie.scattering"] == pytest.approx(
        small_fit.parameters["mie.scattering"], rel=1e-12
    )
    samples = small_fit.samples
    assert samples["model"].shape == samples["value"].shape
    assert np.nanmax(np.abs(np.log(samples["model"] / samples["value"]))) < 2


def test_a_fit_of_arrays_is_that_of_the_reference(small_fit):
    sky = skyfit.read("cie:12", sun_zenith_deg=[20, 60])
    at, values = {name: value for name, (_, value) in sky.samples.coords.items()}, sky.samples
    again = skyfit.reference(
        values["value"],
        at["sun_zenith_deg"],
        at["view_zenith_deg"],
        at["relative_azimuth_deg"],
        quantity="relative luminance",
        name="cie:12",  # by which a standard sky is known
    )
    options = {k: v for k, v in FIT.items() if k != "sun_zenith_deg"}
    angles = 1e-9  # of degrees and back
    for name, value in skyfit.fit(again, **options).parameters.items():
        assert value == pytest.approx(small_fit.parameters[name], rel=angles)


def test_a_fit_of_irradiances_is_that_of_the_program(tmp_path):
    text = "direct=96000lx,diffuse=13500lx"
    run(
        "fit", "--irradiance", text, "--sun-zenith-deg", 32, "--starts", 1, "--out",
        tmp_path / "fit",
    )  # fmt: skip
    theirs = json.loads((tmp_path / "fit" / "preset.json").read_text())
    ours = skyfit.fit(irradiance=text, sun_zenith_deg=32, starts=1)
    assert without_time(json.loads(ours.preset.to_json())) == without_time(theirs)
    read = skyfit.read_irradiances(text, sun_zenith_deg=32)
    assert skyfit.fit(read, starts=1).parameters == ours.parameters
    assert read.quantity == "illuminance"
    names = list(read.samples.coords["irradiance"][1])
    assert names == ["direct_normal", "diffuse_horizontal"]
    assert list(read.samples["value"]) == [96000, 13500]


def test_a_fit_of_a_sky_and_irradiances_is_that_of_the_program(tmp_path):
    sky, text = EXAMPLES / "clear_sky_two_suns.csv", "direct=83000lx,diffuse=14000:500lx"
    options = ["--lobes", 1, "--free", "mie.scattering,ground.albedo", "--starts", 1]
    run(
        "fit", "--reference", sky, "--irradiance", text, "--sun-zenith-deg", 30, *options,
        "--out", tmp_path / "fit",
    )  # fmt: skip
    theirs = json.loads((tmp_path / "fit" / "preset.json").read_text())
    how = {"lobes": 1, "free": ["mie.scattering", "ground.albedo"], "starts": 1}
    ours = skyfit.fit(sky, irradiance=text, sun_zenith_deg=30, **how)
    assert without_time(json.loads(ours.preset.to_json())) == without_time(theirs)
    assert ours.report_dict["irradiances"]["diffuse_horizontal"]["samples"] == 1
    read = skyfit.fit(skyfit.read(sky), irradiance=text, sun_zenith_deg=30, **how)
    assert read.parameters == ours.parameters
    which = list(ours.samples.coords["irradiance"][1])
    assert which[-2:] == ["direct_normal", "diffuse_horizontal"]
    assert set(which[:-2]) == {""}


def test_a_measured_sky_is_read():
    sky = skyfit.read(EXAMPLES / "clear_sky_two_suns.csv")
    rows = [line for line in (EXAMPLES / "clear_sky_two_suns.csv").open() if line[0] != "#"][1:]
    assert len(sky) == len(sky.samples["value"]) == len(rows) > 0


def test_compare_is_that_of_the_program(tmp_path):
    ours = skyfit.compare("truth:earth-550nm-ground", models=["reference", "oneil"])
    run(
        "compare", "--reference", "truth:earth-550nm-ground", "--models", "reference,oneil",
        "--out", tmp_path / "compared",
    )  # fmt: skip
    theirs = json.loads((tmp_path / "compared" / "comparison.json").read_text())

    def errors(report):
        times = {"precompute_s", "time_per_direction_us"}
        return [{k: v for k, v in row.items() if k not in times} for row in report["models"]]

    assert errors(ours.report_dict) == errors(theirs)
    assert ours.values("reference").shape == (len(ours.reference),)


@pytest.fixture(scope="module")
def frame():
    return skyfit.render("earth-clear", view="sunset", size=(32, 18), samples_per_side=1)


def test_render_is_that_of_the_program(frame, tmp_path):
    assert frame.rgb.shape == (18, 32, 3) and frame.rgb.dtype == np.float32
    assert frame.luminance.shape == frame.depth_m.shape == (18, 32)
    assert not frame.rgb.flags.owndata  # a view of the frame's memory
    frame.save(tmp_path / "ours.exr")
    run(
        "render", "--preset", "earth-clear", "--view", "sunset", "--size", "32x18",
        "--samples-per-side", 1, "--out", tmp_path / "theirs.exr",
    )  # fmt: skip
    date = rb"\d{4}:\d\d:\d\d \d\d:\d\d:\d\d"  # when the file was written
    ours, theirs = (
        re.sub(date, b"", (tmp_path / name).read_bytes()) for name in ("ours.exr", "theirs.exr")
    )
    assert ours == theirs


def test_arrays_hold_the_memory_that_they_show():
    values = skyfit.sky("earth-clear", 30, VIEWS)["luminance_cd_m2"]
    assert not values.flags.owndata
    before = values.copy()
    gc.collect()
    assert np.array_equal(values, before)


def test_planes_of_a_frame_hold_the_frame(frame):
    owner = frame.rgb
    while isinstance(owner, np.ndarray):
        owner = owner.base
    assert owner is frame


def test_other_threads_run_during_work():
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.001):
            ticks.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    suns = np.linspace(0, 85, 30)[:, None]
    skyfit.sky("earth-clear", suns, VIEWS, wavelength_nm=range(400, 700, 10))
    end = time.perf_counter()
    done.set()
    thread.join()
    # With the lock held there would be at most one, before the work begins.
    assert len([tick for tick in ticks if begin < tick < end]) > 3


def test_an_interrupted_fit_raises_and_the_next_one_is_whole(small_fit):
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        skyfit.fit("cie:12", starts=1000, bootstrap=100_000)  # hours
    timer.join()
    again = skyfit.fit("cie:12", **FIT)
    assert without_time(again.report_dict) == without_time(small_fit.report_dict)

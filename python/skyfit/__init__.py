# SPDX-License-Identifier: Apache-2.0
"""Fits an atmosphere to a sky, evaluates and renders it.

The numbers are those of the program `skyfit`, of the same code; options have the names of its
command line with underscores: ``--sun-zenith-deg`` is ``sun_zenith_deg``. Angles are in degrees,
lengths in metres, wavelengths in nm.

    >>> import skyfit
    >>> sky = skyfit.sky("earth-clear", sun_zenith_deg=30, view_zenith_deg=[0, 45, 80])
    >>> sky["luminance_cd_m2"].shape
    (3,)
"""

import json as _json
import os as _os
from collections.abc import Mapping as _Mapping

import numpy as _np

from . import _skyfit
from ._skyfit import (
    Comparison,
    Fit,
    Frame,
    Preset,
    Reference,
    default_threads,
    models,
    preset_names,
    reference_names,
    views,
)

__version__ = _skyfit.__version__
__all__ = [
    "Arrays",
    "Comparison",
    "Fit",
    "Frame",
    "Preset",
    "Reference",
    "compare",
    "default_threads",
    "fit",
    "irradiance",
    "models",
    "preset_names",
    "read",
    "read_irradiances",
    "reference",
    "reference_names",
    "render",
    "sky",
    "views",
]

_MAX_ALTITUDE_M, _MAX_THREADS = 1e12, 1024  # as in `skyfit sky`
_MAX_SCANS = 2**31 - 1


class Arrays(_Mapping):
    """Arrays by name, each with the names of its dimensions.

    The names hold the unit. ``numpy.asarray()`` gives the first array, ``to_xarray()`` all of them
    with their coordinates.
    """

    def __init__(self, arrays, dims, coords):
        self._arrays, self._dims, self._coords = arrays, dims, coords

    def __getitem__(self, name):
        return self._arrays[name]

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    def __array__(self, dtype=None):
        return _np.asarray(next(iter(self._arrays.values())), dtype)

    def dims(self, name):
        """Names of the dimensions of an array, outermost first."""
        return self._dims[name]

    @property
    def coords(self):
        """What the arrays depend on: (names of dimensions, values) by name."""
        return dict(self._coords)

    def to_xarray(self):
        """An xarray.Dataset of the same arrays; needs xarray."""
        import xarray

        return xarray.Dataset(
            {name: (self._dims[name], array) for name, array in self._arrays.items()},
            self._coords,
        )

    def __repr__(self):
        rows = [f"  {name} {self._dims[name]} {array.shape}" for name, array in self.items()]
        return "<skyfit.Arrays\n" + "\n".join(rows) + ">"


def _from_json(text_or_dict, source="preset"):
    """From the text of a preset file, or what json.loads() makes of it.

    `source` is the name that messages show.
    """
    text = text_or_dict if isinstance(text_or_dict, str) else _json.dumps(text_or_dict)
    return Preset._parse(text, source)


Preset.from_json = staticmethod(_from_json)
Preset.to_dict = lambda self: _json.loads(self.to_json())
Preset.to_dict.__doc__ = "What json.loads() makes of to_json()."


def _preset(preset):
    if isinstance(preset, Preset):
        return preset
    if not isinstance(preset, (str, _os.PathLike)):
        raise ValueError(
            "preset: expected a Preset, a shipped preset's name or a file, "
            f"got {type(preset).__name__}"
        )
    return Preset(preset)


def _word(value):
    """One value as the command line spells it."""
    if isinstance(value, str):
        return value
    if _is_whole(value):
        return str(int(value))
    if isinstance(value, _os.PathLike):
        return _os.fspath(value)
    return repr(float(value))


def _pair(value):
    """A value, or (mean, sigma) and (lower, upper), as the command line spells them."""
    return ":".join(map(_word, value)) if _is_list(value) else _word(value)


def _is_whole(value):
    return isinstance(value, (int, _np.integer)) and not isinstance(value, bool)


def _is_list(value):
    if isinstance(value, _np.ndarray):
        return value.ndim > 0
    return isinstance(value, (list, tuple, set, frozenset, range))


# Tuples of numbers that the command line joins by something else than a comma.
_SEPARATORS = {"size": "x", "height_range_m": "..", "noise": ":"}


def _words(name, value):
    if _is_flag(value):  # True, see _options()
        return []
    try:
        if isinstance(value, _Mapping):
            return [f"{key}={_pair(one)}" for key, one in value.items()]
        if _is_list(value):
            words = [_word(one) for one in value]
            return [_SEPARATORS[name].join(words)] if name in _SEPARATORS else words
        return [_word(value)]
    except (TypeError, ValueError):
        raise ValueError(
            f"{name}: expected numbers, texts or files, alone, in a list or as a dict's values"
        ) from None


def _options(options):
    """The options that are given; None and False are not."""
    return {
        name: _words(name, value)
        for name, value in options.items()
        if value is not None and not (_is_flag(value) and not value)
    }


def _is_flag(value):
    return isinstance(value, (bool, _np.bool_))


def _flag(name, value):
    if not _is_flag(value):
        raise ValueError(f"{name}: expected True or False")
    return bool(value)


def _numbers(name, values):
    if _np.ma.is_masked(values):
        raise ValueError(f"{name}: expected numbers, got masked elements")
    try:
        return _np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: expected a number or an array of numbers") from None


def _within(name, values, lower, upper):
    values = _numbers(name, values)
    bad = ~((values >= lower) & (values <= upper))
    if bad.any():
        first = values[bad].flat[0]
        raise ValueError(f"{name} = {first:g}: expected a number from {lower:g} to {upper:g}")
    return values


def _points(values):
    """Broadcasts; the shape, the flat arrays and the coordinates."""
    arrays = _np.broadcast_arrays(*values.values())
    shape = arrays[0].shape
    dims = tuple(f"point_{k}" for k in range(len(shape)))
    coords = {name: (dims, array) for name, array in zip(values, arrays)}
    return shape, dims, coords, [_np.ascontiguousarray(array).ravel() for array in arrays]


def _shaped(flat, shape, dims, coords, wavelength_nm, derivatives):
    """Gives flat arrays their shapes; what begins with d_ has the parameters first."""
    if wavelength_nm is not None and _np.ndim(wavelength_nm) > 0:
        nm = _np.asarray(wavelength_nm, dtype=float)
        if nm.ndim != 1:
            raise ValueError("wavelength_nm: expected a number or a list of numbers")
        shape, dims = (*shape, len(nm)), (*dims, "wavelength_nm")
        coords = {**coords, "wavelength_nm": ("wavelength_nm", nm)}
    elif wavelength_nm is not None:
        coords = {**coords, "wavelength_nm": ((), float(wavelength_nm))}
    if derivatives:
        coords = {**coords, "parameter": ("parameter", list(derivatives))}
    arrays, names = {}, {}
    for name, values in flat:
        derived = name.startswith("d_")
        names[name] = ("parameter", *dims) if derived else dims
        arrays[name] = values.reshape((len(derivatives), *shape) if derived else shape)
    return Arrays(arrays, names, coords)


def _how(model, derivatives, scalar, refraction, threads):
    if isinstance(derivatives, str):
        derivatives = [derivatives]
    derivatives = list(derivatives or [])
    if threads is None:
        threads = default_threads()
    if not _is_whole(threads) or not 1 <= threads <= _MAX_THREADS:
        raise ValueError(f"threads: expected a whole number from 1 to {_MAX_THREADS}")
    flags = _flag("scalar", scalar), _flag("refraction", refraction)
    return _skyfit.How(model, derivatives, *flags, int(threads)), derivatives


def _wavelengths(wavelength_nm):
    if wavelength_nm is None:
        return None
    nm = _np.atleast_1d(_numbers("wavelength_nm", wavelength_nm))
    if nm.size == 0:
        raise ValueError("wavelength_nm: expected at least one number")
    return nm


def sky(
    preset,
    sun_zenith_deg,
    view_zenith_deg,
    azimuth_deg=0,
    altitude_m=0,
    wavelength_nm=None,
    *,
    model="reference",
    derivatives=None,
    stokes=False,
    scalar=False,
    refraction=False,
    threads=None,
):
    """The light of the sky at points, as `skyfit sky` computes it.

    The four places broadcast like NumPy's arrays; `azimuth_deg` is the view's relative to the
    sun's. Without `wavelength_nm` the result holds ``luminance_cd_m2``; with it
    ``radiance_per_irradiance_sr`` with the wavelengths as the last dimension, unless it is one
    number. ``stokes=True`` adds Q, U, degree and angle of linear polarisation and needs
    wavelengths. `derivatives` names parameters: ``d_...`` holds the exact derivative by each, in
    the value's unit per the parameter's, the parameters as the first dimension. ``scalar=True``
    leaves polarisation out of the light; ``refraction=True`` curves the rays. Results do not depend
    on `threads`.
    """
    places = {
        "altitude_m": _within("altitude_m", altitude_m, 0, _MAX_ALTITUDE_M),
        "sun_zenith_deg": _within("sun_zenith_deg", sun_zenith_deg, 0, 180),
        "view_zenith_deg": _within("view_zenith_deg", view_zenith_deg, 0, 180),
        "relative_azimuth_deg": _within("azimuth_deg", azimuth_deg, -360, 360),
    }
    shape, dims, coords, flat = _points(places)
    how, derivatives = _how(model, derivatives, scalar, refraction, threads)
    nm = _wavelengths(wavelength_nm)
    stokes = _flag("stokes", stokes)
    if stokes and nm is None:
        raise ValueError("wavelength_nm: expected wavelengths with stokes=True")
    if stokes and scalar:
        raise ValueError("scalar: expected without stokes=True")
    call = _skyfit.stokes if stokes else _skyfit.sky
    values = call(_preset(preset), *flat, nm, how)
    return _shaped(values, shape, dims, coords, wavelength_nm, derivatives)


def irradiance(
    preset,
    sun_zenith_deg,
    altitude_m=0,
    wavelength_nm=None,
    *,
    model="reference",
    derivatives=None,
    scalar=False,
    refraction=False,
    threads=None,
):
    """Direct normal and horizontal, diffuse and global irradiance, as `skyfit sky --irradiance`.

    In lx, or in W m^-2 nm^-1 at wavelengths. Shapes and options are those of sky().
    """
    places = {
        "altitude_m": _within("altitude_m", altitude_m, 0, _MAX_ALTITUDE_M),
        "sun_zenith_deg": _within("sun_zenith_deg", sun_zenith_deg, 0, 180),
    }
    shape, dims, coords, flat = _points(places)
    how, derivatives = _how(model, derivatives, scalar, refraction, threads)
    values = _skyfit.irradiance(_preset(preset), *flat, _wavelengths(wavelength_nm), how)
    return _shaped(values, shape, dims, coords, wavelength_nm, derivatives)


def read(name_or_files, **options):
    """A standard sky (``"cie:12"``), a table of truth, or measured skies from one file or several.

    The options are those of `skyfit fit` for references: `sampling` and `sun_zenith_deg` of
    standard skies, and what a measured file leaves open (docs/measured-skies.md).
    """
    return _skyfit.read(_names(name_or_files), _options(options))


def _names(name_or_files):
    if isinstance(name_or_files, (list, tuple)):
        return ",".join(map(_os.fspath, name_or_files))
    return _os.fspath(name_or_files)


def read_irradiances(text_or_file, **options):
    """Irradiances as a reference: values of one sun, a CSV, or an hour of a weather file.

    ``read_irradiances("direct=96000lx,diffuse=13500lx", sun_zenith_deg=32)``, as `skyfit fit
    --irradiance` has them (docs/fits.md); the options are those of read().
    """
    return _skyfit.read_irradiances(_os.fspath(text_or_file), _options(options))


def reference(
    value,
    sun_zenith_deg,
    view_zenith_deg,
    relative_azimuth_deg,
    *,
    quantity,
    wavelength_nm=0,
    sigma=_np.nan,
    weight=1,
    scan=None,
    name="arrays",
):
    """A reference of arrays that broadcast, one element a sample.

    `quantity` is "luminance" (cd/m^2), "relative luminance" (a factor per scan is free) or
    "spectral radiance" (W m^-2 sr^-1 nm^-1 at `wavelength_nm`). `sigma` is one standard deviation,
    NaN where it is not known. A sample of weight 0 is not fitted. `scan` numbers the scans from 0;
    without it every sun zenith angle is one.
    """
    arrays = _np.broadcast_arrays(
        _numbers("sun_zenith_deg", sun_zenith_deg),
        _numbers("view_zenith_deg", view_zenith_deg),
        _numbers("relative_azimuth_deg", relative_azimuth_deg),
        _numbers("wavelength_nm", wavelength_nm),
        _numbers("value", value),
        _numbers("sigma", sigma),
        _numbers("weight", weight),
    )
    sun, view, azimuth, nm, value, sigma, weight = (
        _np.ascontiguousarray(array, dtype=float).ravel() for array in arrays
    )
    sun, view = _within("sun_zenith_deg", sun, 0, 180), _within("view_zenith_deg", view, 0, 180)
    azimuth = _within("relative_azimuth_deg", azimuth, -360, 360)
    if scan is None:
        scan = _np.unique(sun, return_inverse=True)[1]
    else:
        numbers = _within("scan", scan, 0, _MAX_SCANS)
        if (numbers != _np.floor(numbers)).any():
            raise ValueError("scan: expected whole numbers")
        scan = _np.broadcast_to(numbers.astype(int), arrays[0].shape).ravel()
    places = _np.stack([scan, view, azimuth])
    direction = _np.unique(places, axis=1, return_inverse=True)[1].ravel()
    return _skyfit.reference_of(
        name, quantity, sun, view, azimuth, nm, value, sigma, weight, scan, direction
    )


def _given_preset(options):
    preset = options.pop("preset", None)
    return None if preset is None else _preset(preset)


def fit(reference=None, *, irradiance=None, **options):
    """Fits an atmosphere to a reference, as `skyfit fit`; the same options, the same numbers.

    `reference` is what read() takes or gives, or what read_irradiances() gives; `irradiance`, in
    its place or beside it, is what that takes. Lists are lists, ``free=["mie.scattering"]``;
    assignments are dicts, ``fix={"ground.albedo": 0.2}``, ``prior={"ozone.column": (300, 20)}``,
    ``bounds={"mie.phase.g1": (0.5, 0.9)}``; flags are ``True``. Ctrl-C ends the fit at the next
    evaluation of the model.
    """
    options = dict(options)
    preset = _given_preset(options)
    if reference is None and irradiance is None:
        raise ValueError("fit: expected a reference, irradiance or both")
    is_read = isinstance(reference, Reference)
    if irradiance is not None or not is_read:
        known = {name: options.pop(name) for name in _READING if name in options}
        if irradiance is None:
            reference = read(reference, **known)
        elif reference is None:
            reference = read_irradiances(irradiance, **known)
        else:
            known = _options({**known, "irradiance": _os.fspath(irradiance)})
            reference = (
                _skyfit.with_irradiances(reference, known)
                if is_read
                else _skyfit.read_with_irradiances(_names(reference), known)
            )
    return _skyfit.fit(reference, preset, _options(options))


def compare(reference, **options):
    """Compares sky models with a reference, as `skyfit compare`; the same options and numbers."""
    options = dict(options)
    preset = _given_preset(options)
    if not isinstance(reference, Reference):
        reference = _os.fspath(reference)
    return _skyfit.compare(reference, preset, _options(options))


def render(preset, **options):
    """Draws one frame, as `skyfit render`; the same options.

    ``render("earth-clear", view="sunset", size=(640, 360))`` gives a Frame whose ``rgb`` is linear
    light in cd/m^2, float32 [row][column][3].
    """
    return _skyfit.render(_preset(preset), _options(options))


_READING = frozenset(_skyfit.reading_options())


def _samples(self):
    """Samples by name: value, sigma (NaN where none is stated), weight; of a fit the values of the
    fitted and of the start's model, and as sigma what one sample scatters by. The places, scans and
    which irradiance, where they are such, are their `coords`."""
    arrays = self._samples() if isinstance(self, Fit) else self._arrays()
    places = (
        "sun_zenith_deg",
        "view_zenith_deg",
        "relative_azimuth_deg",
        "wavelength_nm",
        "scan",
        "irradiance",
    )
    coords = {name: ("sample", arrays.pop(name)) for name in places if name in arrays}
    return Arrays(arrays, dict.fromkeys(arrays, ("sample",)), coords)


Reference.samples = property(_samples)
Fit.samples = property(_samples)
Fit.report_dict = property(
    lambda self: _json.loads(self._report_json()), doc="What json.loads() makes of report.json."
)
Comparison.report_dict = property(
    lambda self: _json.loads(self._json()), doc="What json.loads() makes of comparison.json."
)

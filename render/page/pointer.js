// SPDX-License-Identifier: Apache-2.0
// What the pointer and the keys do.

function listenToView(canvas) {
  let held = null;  // the direction under the pointer when it went down
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    held = [event.clientX, event.clientY];
    pointer = [event.clientX, event.clientY];
    redraw();
  });
  canvas.addEventListener('pointermove', (event) => {
    pointer = [event.clientX, event.clientY];
    if (!held) return redraw();
    const [tx, ty] = tangent(), across = (2 * tx) / canvas.clientWidth,
               along = (2 * ty) / canvas.clientHeight;
    state.azimuth =
        (state.azimuth - (event.clientX - held[0]) * across / Math.max(Math.cos(elevation()), 0.3) +
         4 * Math.PI) %
        (2 * Math.PI);
    state.pitch = clamp(
        state.pitch + (event.clientY - held[1]) * along, dip() - Math.PI / 2, dip() + Math.PI / 2);
    held = [...pointer];
    show();
  });
  for (const end of ['pointerup', 'pointercancel'])
    canvas.addEventListener(end, () => {
      held = null;
    });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    state.field = clamp(state.field * Math.exp(0.001 * event.deltaY), 5 * kDegree, 120 * kDegree);
    show();
  }, {passive: false});
  canvas.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [
                    0, -1
                  ]}[event.key];
    if (!step) return;
    event.preventDefault();
    state.azimuth = (state.azimuth + 3 * kDegree * step[0] + 2 * Math.PI) % (2 * Math.PI);
    state.pitch =
        clamp(state.pitch + 3 * kDegree * step[1], dip() - Math.PI / 2, dip() + Math.PI / 2);
    show();
  });
}

function listenToSun(handle) {
  handle.addEventListener('pointerdown', (event) => {
    handle.setPointerCapture(event.pointerId);
    handle.classList.add('dragged');
  });
  handle.addEventListener('pointermove', (event) => {
    pointer = [event.clientX, event.clientY];
    if (!handle.classList.contains('dragged')) return redraw();
    const at = anglesOf(directionAt(...pointer));
    state.sunElevation = Math.max(at.elevation, kLowestSun);
    state.sunAzimuth = at.azimuth;
    show();
  });
  for (const end of ['pointerup', 'pointercancel'])
    handle.addEventListener(end, () => handle.classList.remove('dragged'));
}

function listen() {
  listenToView(element('sky'));
  listenToSun(element('sun'));
  for (const {id, set} of controls)
    element(id).addEventListener('input', (event) => {
      set(Number(event.target.value));
      show();
    });
  element('to-sun').addEventListener('click', () => {
    state.azimuth = state.sunAzimuth;
    state.pitch = Math.max(state.sunElevation + dip(), 0);
    show();
  });
  element('toggle').addEventListener('click', () => {
    const open = element('toggle').getAttribute('aria-expanded') === 'true';
    element('toggle').setAttribute('aria-expanded', String(!open));
  });
  addEventListener('resize', redraw);
  addEventListener('hashchange', () => {
    readAddress();
    show();
  });
}

// SPDX-License-Identifier: Apache-2.0
// The sliders of the atmosphere's parameters.

// Position -1 to 1 of a value, 0 at the preset's, and back; even in the value or its logarithm on
// either side.
function sliderPosition(slider, value) {
  const even = slider.logarithmic ? Math.log : (x) => x;
  const end = value < slider.value ? slider.low : slider.high;
  return end === slider.value ? 0 :
                                Math.sign(value - slider.value) *
          (even(value) - even(slider.value)) / (even(end) - even(slider.value));
}
function sliderValue(slider, position) {
  const end = position < 0 ? slider.low : slider.high, share = Math.abs(position);
  return slider.logarithmic ? slider.value * (end / slider.value) ** share :
                              slider.value + share * (end - slider.value);
}

function addSliders() {
  const values = data.sliders.map((slider) => slider.value), shows = [];
  const apply = () => {
    renderer.setParameters(values);
    drawMoving();
  };
  data.sliders.forEach((slider, i) => {
    const id = `parameter-${i}`, label = document.createElement('label'),
          output = document.createElement('output');
    label.className = 'row';
    label.htmlFor = id;
    const name = textElement('code', '');
    name.append(
        ...slider.name.split(/(?<=[._])/).flatMap((part) => [part, document.createElement('wbr')]));
    label.append(name, output);
    const input = document.createElement('input');
    Object.assign(input, {
      id,
      type: 'range',
      min: slider.low < slider.value ? -1 : 0,
      max: slider.high > slider.value ? 1 : 0,
      step: 0.01
    });
    if (slider.sigma) {
      const percent = (value) =>
          (100 * (sliderPosition(slider, clamp(value, slider.low, slider.high)) - input.min)) /
          (input.max - input.min);
      const [from, to] =
          [percent(slider.value - slider.sigma), percent(slider.value + slider.sigma)];
      input.style.setProperty(
          '--sigma',
          `linear-gradient(90deg, transparent ${from}%, var(--band) ${from}% ${to}%, transparent ${
              to}%)`);
    }
    const showValue = () => {
      input.value = sliderPosition(slider, values[i]);
      output.textContent = quantity(values[i], slider.unit);
    };
    input.addEventListener('input', () => {
      values[i] = sliderValue(slider, Number(input.value));
      showValue();
      apply();
    });
    const sigma = slider.sigma ?
        `; one sigma of the fit, the band: ±${quantity(slider.sigma, slider.unit)}` :
        '';
    element('sliders').append(label, textElement('p', slider.meaning + sigma, 'meaning'), input);
    shows.push(showValue);
    showValue();
  });
  element('reset').addEventListener('click', () => {
    data.sliders.forEach((slider, i) => {
      values[i] = slider.value;
    });
    shows.forEach((showValue) => showValue());
    apply();
  });
  element('atmosphere').hidden = data.sliders.length === 0;
}

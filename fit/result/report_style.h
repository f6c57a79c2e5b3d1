// SPDX-License-Identifier: Apache-2.0
// Style and script of the report as a page.
#pragma once

namespace skyfit::fit {

// No character of either needs escaping in XML.
inline constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ink: #1b1f24; --faint: #59626d; --line: #d4d9df; --paper: #ffffff; --mark: #b3430a; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e8ec; --faint: #9aa5b1; --line: #3a424c; --paper: #15191e; --mark: #ff9a5c; }
  figure svg { filter: invert(0.9) hue-rotate(180deg); }
}
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 62rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 0.3rem; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 0.6rem; border-bottom: 1px solid var(--line); }
p.lead { font-size: 1.1rem; margin: 0; }
p.small, figcaption, td.small { color: var(--faint); font-size: 0.88rem; }
.mark { color: var(--mark); }
dl { display: grid; grid-template-columns: 8rem 1fr; gap: 0.2rem 1rem; margin: 0; }
dt { color: var(--faint); }
dd { margin: 0; overflow-wrap: anywhere; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.92rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.7rem; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child, td.text { text-align: left; }
td.text { white-space: normal; }
figure { margin: 1rem 0; }
figure svg { width: 100%; height: auto; }
pre { font-size: 0.8rem; overflow: auto; max-height: 30rem; border: 1px solid var(--line); padding: 0.7rem; }
button { font: inherit; }
a { color: var(--mark); }
iframe { width: 100%; height: 34rem; border: 1px solid var(--line); margin-top: 0.6rem; }
@media print { button, details { display: none; } body { max-width: none; } h2 { break-after: avoid; } tr, figure { break-inside: avoid; } }
)css";

// The preset is the text of the page's <pre>, so that it stands in the file once.
inline constexpr const char* kScript = R"js(
document.getElementById('download').onclick = function () {
  const text = document.getElementById('preset').textContent;
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  link.download = 'preset.json';
  link.click();
  URL.revokeObjectURL(link.href);
};
)js";

}  // namespace skyfit::fit

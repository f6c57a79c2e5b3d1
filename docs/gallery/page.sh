# SPDX-License-Identifier: Apache-2.0
# How make.sh draws pictures and writes the page. It sets skyfit, the program; out, the folder; page, the file; and scratch,
# a folder for the time of the run.
# shellcheck shell=bash disable=SC2154  # set by make.sh

commands=""

begin_page() {
  cat >"$page" <<'HTML'
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>skyfit: the figures of its sources</title>
<style>
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
h2 { margin-top: 3rem; border-bottom: 1px solid gray; }
.row { display: flex; flex-wrap: wrap; gap: 0.6rem; }
figure { margin: 0; }
figure img { max-width: 100%; display: block; }
figcaption { font-size: 0.85rem; opacity: 0.75; }
pre { overflow: auto; font-size: 0.8rem; }
</style>
</head>
<body>
<h1>The figures of the sources</h1>
<p>Each picture is made by the command under it, from the model of the source and from skyfit's <code>reference</code>
(spherical, polarised, all orders of scattering) in the same atmosphere. <code>./run gallery</code> makes the page anew. What
the sources do not state (sun, place, exposure) is chosen here. The last section names what cannot be shown.</p>
HTML
}

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }

# keep FILE NAME: the picture as NAME.jpg, in the figure.
keep() {
  oiiotool "$1" --ch R,G,B --compression jpeg:88 -o "$out/$2.jpg"
  pictures+=("$2")
}

# picture NAME ARGUMENTS: one frame or strip, kept as NAME.jpg; its command goes under the figure.
picture() {
  local name=$1
  shift
  commands+="skyfit render $* --out $name.png"$'\n'
  "$skyfit" render "$@" --out "$scratch/$name.png" >/dev/null
  keep "$scratch/$name.png" "$name"
}

# both NAME MODEL ARGUMENTS: the picture by the source's model and by the reference.
both() {
  local name=$1 model=$2
  shift 2
  picture "$name-${model//:/-}" --model "$model" "$@"
  picture "$name-reference" "$@"
}

# panels NAME PARTS ARGUMENTS: parts of a frame, as `skyfit render --panels` writes them, and "picture", the frame itself.
panels() {
  local name=$1 parts=$2 part
  shift 2
  commands+="skyfit render $* --panels --out $name.png    # $parts"$'\n'
  "$skyfit" render "$@" --panels --out "$scratch/$name.png" >/dev/null
  for part in $parts; do
    if [[ $part == picture ]]; then keep "$scratch/$name.png" "$name"; else keep "$scratch/$name.$part.png" "$name.$part"; fi
  done
}

# plotted NAME ARGUMENTS: a figure of `skyfit plot`.
plotted() {
  local name=$1
  shift
  commands+="skyfit plot $* --out $name.png"$'\n'
  "$skyfit" plot "$@" --out "$scratch/$name.png" >/dev/null
  keep "$scratch/$name.png" "$name"
}

source_of() { # ID TITLE
  printf '<h2 id="%s">%s</h2>\n' "$1" "$(escaped <<<"$2")" >>"$page"
}

begin() {
  pictures=()
  commands=""
  table=""
}

# figure TITLE WHAT-IS-TO-BE-SEEN CAPTION...: with the pictures, or a table, since begin, each with its caption.
figure() {
  local title=$1 seen=$2 i
  shift 2
  commands=${commands//"$scratch/"/}
  {
    printf '<section><h3>%s</h3>\n<p>%s</p>\n<div class="row">\n' "$(escaped <<<"$title")" "$(escaped <<<"$seen")"
    for i in "${!pictures[@]}"; do
      printf '<figure><img loading="lazy" src="%s.jpg" alt="%s"><figcaption>%s</figcaption></figure>\n' \
        "${pictures[$i]}" "$(escaped <<<"$title")" "$(escaped <<<"${1-}")"
      shift || true
    done
    [[ -z $table ]] || printf '<pre>%s</pre>\n' "$table"
    printf '</div>\n<details><summary>Commands</summary><pre>%s</pre></details></section>\n' "$(escaped <<<"$commands")"
  } >>"$page"
}

# text TITLE WHAT-IS-TO-BE-SEEN ARGUMENTS: what a command prints.
text() {
  local title=$1 seen=$2
  shift 2
  {
    printf '<section><h3>%s</h3>\n<p>%s</p>\n<pre>skyfit %s\n\n' "$(escaped <<<"$title")" "$(escaped <<<"$seen")" "$(escaped <<<"$*")"
    "$skyfit" "$@" | escaped
    printf '</pre></section>\n'
  } >>"$page"
}

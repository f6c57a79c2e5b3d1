#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws what the sources of the models show and writes the page that holds it: for each figure the
# source's own model, beside it the reference model, what is to be seen, and the commands.
#
#   make.sh SKYFIT DIRECTORY
set -euo pipefail

skyfit=$1 out=$2
mkdir -p "$out"
page=$out/index.html
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=docs/gallery/page.sh
source "$(dirname "$0")/page.sh"

begin_page
small=(--size 320x180)
strip=(--size 200x150)

# --- Sperlhofer 2011 --------------------------------------------------------------------------------------------------
s11=(--preset sperlhofer-2011)
source_of s11 "Sperlhofer 2011: tables of Bruneton and Neyret, deferred shading"
text "Tables 4-1 and 4-2: the atmosphere" "The published coefficients as a preset, and what they amount to." check sperlhofer-2011

# Pictures of grass and stone, and of their normals, from slices of the program's own textures.
ground=$scratch/ground
mkdir "$ground"
"$skyfit" render "${s11[@]}" --textures "$ground" --size 32x18 --out "$scratch/ground.png" >/dev/null
oiiotool "$ground/grains.png" --cut 64x64+0+0 --ch A,A,A --mulc 0.6,0.85,0.35 -o "$ground/grass.png"
oiiotool "$ground/crags.png" --cut 64x64+0+0 --ch A,A,A --mulc 1,0.93,0.85 -o "$ground/stone.png"
oiiotool "$ground/grains.png" --cut 64x64+0+0 --ch R,G,B --mulc -0.5,0.5,0 --addc 0.749,0.251,1 -o "$ground/grass-normal.png"
oiiotool "$ground/crags.png" --cut 64x64+0+0 --ch R,G,B --mulc -0.7,0.7,0 --addc 0.849,0.151,1 -o "$ground/stone-normal.png"
materials() { # NORMAL-OF-GRASS NORMAL-OF-STONE
  printf '{"skyfit_materials": 1,\n "soil": {"color": "grass.png"%s, "near_m": 2, "far_m": 60},\n "rock": {"color": "stone.png"%s, "near_m": 8, "far_m": 120}}\n' \
    "$1" "$2" >"$ground/materials.json"
}
textured() { picture "$1" --textures "$ground" "${@:2}"; } # NAME ARGUMENTS: a picture with them
materials ', "normal": "grass-normal.png"' ', "normal": "stone-normal.png"'
begin
textured s11-4-13-far "${s11[@]}" --model bruneton --view valley --sun-zenith-deg 60 "${small[@]}"
textured s11-4-13-near "${s11[@]}" --model bruneton --view valley --sun-zenith-deg 60 --view-zenith-deg 105 "${small[@]}"
textured s11-4-13-eye "${s11[@]}" --model bruneton --view ground --sun-zenith-deg 60 --azimuth-deg 100 --view-zenith-deg 105 "${small[@]}"
commands+=$'# ground/materials.json\n'$(<"$ground/materials.json")$'\n'
figure "4-13: textured terrain at several scales" "Stone high and steep, grass low and level. Each has two scales, 2 and 60 m, 8 and 120 m, and repeats do not show." \
  "far and near" "down the slope" "from 2 m"
begin
textured s11-4-17-normals "${s11[@]}" --model bruneton --view ground --sun-zenith-deg 75 --azimuth-deg 100 --view-zenith-deg 110 "${small[@]}"
materials ', "normal": "level.png"' ', "normal": "level.png"'
oiiotool --pattern constant:color=0.5,0.5,1 64x64 3 -o "$ground/level.png"
textured s11-4-17-level "${s11[@]}" --model bruneton --view ground --sun-zenith-deg 75 --azimuth-deg 100 --view-zenith-deg 110 "${small[@]}"
figure "4-17: normal maps" "Fine relief in the light of a low sun, without more vertices." "normals of the picture" "level normals"

begin
picture s11-4-23-eye "${s11[@]}" --model bruneton --view 10km --block-boxes culling "${small[@]}"
picture s11-4-23-outside "${s11[@]}" --model bruneton --view 10km --block-boxes culling --overview-m 1e6 "${small[@]}"
picture s11-4-23-levels "${s11[@]}" --model bruneton --view 10km --block-boxes level --overview-m 3e5 "${small[@]}"
figure "4-23: culling" "Only the blocks of the view's frustum are drawn. Boxes of drawn blocks are green, of those outside the frustum red, behind the horizon blue." \
  "from the camera" "from 1000 km above it" "from 300 km above it, boxes by level"

# draw_times VIEW: triangles, and the time of the pass that draws them, over the constant of division; the first column, in
# which shaders are compiled, is left out.
draw_times() {
  for _ in 1 2 3; do "$skyfit" render "${timed[@]}" --view "$1" --out "$scratch/times.png"; done | awk -v view="$1" '
    $1 ~ /^[0-7]$/ && NF > 7 { triangles[$1] = $2; blocks[$1] = $3; if (!($1 in ms) || $8 < ms[$1]) ms[$1] = $8 }
    END { for (i = 0; i < 8; ++i)
            if (i % 4) printf "%-8s %5d %8s %11d %8d %10.1f\n", view, 30 + 30 * (i % 4), i < 4 ? "on" : "off", triangles[i], blocks[i], ms[i] }'
}
timed=("${s11[@]}" --model bruneton --strip "lod-constant=58,60,90,120" --rows "culling=on,off" --stats "${small[@]}")
begin
table="view         C  culling   triangles   blocks    draw ms"$'\n'
for view in valley 10km orbit; do
  table+=$(draw_times "$view")$'\n'
  commands+="skyfit render ${timed[*]} --view $view --out times.png"$'\n'
done
figure "4-25: time over the constant of division, with and without culling" \
  "Without culling, 21 to 26 times as many triangles are drawn in the valley, 7 to 8 times from 10 km and from orbit. The time is that of the pass that draws the ground, by the software renderer, the least of three runs; other work of the machine adds to it."

begin
for view in valley 10km; do
  panels "s11-4-40-$view" "albedo in-scatter reflected picture" "${s11[@]}" --model bruneton --view "$view" --size 240x135
done
figure "4-40: the parts of a picture" \
  "Light of the air (in-scatter) and light of the ground as it arrives at the eye (reflected) add up to the picture, before the tone curve. Albedo is the share of sunlight that the ground reflects." \
  "valley: albedo" "in-scatter" "reflected" "picture" "10 km: albedo" "in-scatter" "reflected" "picture"

begin
for tone in clip exponential; do
  picture "s11-4-41-$tone" "${s11[@]}" --model bruneton --view ground --sun-zenith-deg 78 --azimuth-deg 20 --tone "$tone" "${small[@]}"
done
figure "4-41: clipped and mapped" "Clipped, the sky about the sun is one white patch down to the horizon. The tone curve keeps its colours." "--tone clip" "--tone exponential"

begin
picture s11-4-44 "${s11[@]}" --model bruneton --view ground --rows altitude-m=6000e3,400e3,30e3,2e3 --rows pitch-deg=-56,-17,-4,2 \
  --strip sun-zenith-deg=84,30 --metering each "${small[@]}"
figure "4-44: from space to the ground, sunset and midday" "No jump anywhere on the way down." "bruneton; each its own exposure"

# grid ID TITLE SEEN COLUMNS ROWS ARGUMENTS: one picture by each model.
grid() {
  local id=$1 title=$2 seen=$3 columns=$4 rows=$5
  shift 5
  begin
  both "s11-$id" bruneton "${s11[@]}" --view ground --sun-zenith-deg 60 --strip "$columns" --rows "$rows" "${strip[@]}" "$@"
  figure "$title" "$seen" "bruneton" "reference"
}
grid 4-46 "4-46: Rayleigh scattering, half to twice" "Less scattering: a darker sky and less blue shift of the land." \
  rayleigh.scattering=6.75e-6..2.7e-5:3:geometric altitude-m=2000,5000,20000 --pitch-deg -4 --azimuth-deg 120
grid 4-47 "4-47: scale height of the air, 2 to 10 km" "How far up the air reaches." \
  rayleigh.scale_height=2000,6000,10000 altitude-m=2000,5000,20000 --pitch-deg -4 --azimuth-deg 120
grid 4-48 "4-48: Mie scattering, towards the sun" "A larger halo near the ground, hardly any effect higher up." \
  mie.scattering=2e-6,4e-6,8e-6 altitude-m=1000,3000,5000 --pitch-deg 20 --glare none --exposure-ev 1
grid 4-49 "4-49: scale height of the aerosol, 1 to 4 km, towards the sun" "The halo now reaches greater heights." \
  mie.scale_height=1000,2000,4000 altitude-m=1000,3000,5000 --pitch-deg 20 --glare none --exposure-ev 1

begin
for k in 1e-4 3e-4 1e-3; do
  picture "s11-4-42-$k" "${s11[@]}" --model bruneton --view valley --tone exponential --exposure "$k" "${small[@]}"
done
figure "4-42: one scene at exposures of 1 to 3 to 10" "Brighter with the exposure; the greatest washes out." \
  "exposure 1e-4 m^2/cd" "3e-4 m^2/cd" "1e-3 m^2/cd"

begin
for orders in 1 2 all; do
  picture "s11-4-45-$orders" "${s11[@]}" --view valley --orders "$orders" --exposure 2e-4 "${small[@]}"
done
figure "4-45: orders of scattering" "Single scattering alone is too dark; all orders are thicker and bluer." \
  "reference, single scattering" "two orders" "all orders"

begin
cat >"$scratch/body.obj" <<'OBJ'
v 60000 0 0
v -60000 0 0
v 0 60000 0
v 0 -60000 0
v 0 0 60000
v 0 0 -60000
f 1 3 5
f 3 2 5
f 2 4 5
f 4 1 5
f 3 1 6
f 2 3 6
f 4 2 6
f 1 4 6
OBJ
panels s11-4-50 "picture in-scatter" "${s11[@]}" --model bruneton --latitude-deg 0 --longitude-deg 0 --altitude-m 400e3 --heading-deg 90 \
  --pitch-deg -18 --field-of-view-deg 10 --sun-zenith-deg 60 --sun-azimuth-deg 0 \
  --mesh "$scratch/body.obj@0.8,16.5,150e3" --mesh "$scratch/body.obj@-0.8,16.5,60e3" "${small[@]}"
commands+=$'# body.obj\n'$(<"$scratch/body.obj")$'\n'
figure "4-50: objects outside the air and half inside, seen from space" \
  "Both octahedra are 120 km high. The lower one stands with its lower half in the air, which is 60 km high: it hides the air behind it, and has only the light of the air before it." \
  "the picture" "in-scatter"

# Without and with his repairs.
begin
picture s11-5-1 "${s11[@]}" --view 10km --altitude-m 3000 --sun-zenith-deg 70 --field-of-view-deg 10 --pitch-deg -3 \
  --strip model=bruneton:half-transmittance,bruneton --rows mie.scattering=4e-6,3e-5 --metering each "${small[@]}"
figure "5-1: transmittance from a table, and repaired" \
  "Divided in half floats, transmittances are noisy. In his air the noise is too small to be seen here; in seven times the haze so little blue light passes along the horizon that half floats hold next to none of it, and a line of a wrong colour comes. bruneton takes differences of optical depths, he a closed form." \
  "left: a table of half floats, as published; right: bruneton"

begin
horizon=("${s11[@]}" --view sunset --sun-zenith-deg 85 --field-of-view-deg 12 --view-zenith-deg 92 --azimuth-deg 40 --exposure-ev 9 "${small[@]}")
panels s11-5-2-before in-scatter --model bruneton:half-inscatter "${horizon[@]}"
panels s11-5-2-after in-scatter --model bruneton "${horizon[@]}"
figure "5-2: in-scattered light beside the horizon, and repaired" \
  "The light before the ground, nine stops brighter. By radii in single precision a look-up does not know on which side of the horizon it is, and dark patches come. bruneton counts heights from the ground, he takes two samples beside the horizon." \
  "as published, without repair" "bruneton"

begin
picture s11-5-3 "${s11[@]}" --view ground --altitude-m 500 --field-of-view-deg 60 --azimuth-deg 0 \
  --strip model=bruneton:mie-from-rayleigh,bruneton,reference --rows sun-zenith-deg=90,91 --metering each "${small[@]}"
figure "5-3: aerosol of a sun beside the horizon, and repaired" \
  "What is left of the sun's light is red; made from the red by the proportion of the air's light, the aerosol's glow is white. bruneton keeps every wavelength's, he fades all of it." \
  "by the proportion, as published; bruneton; reference"

precisions() { # ID SUN ARGUMENTS: by tables of both precisions
  local id=$1 sun=$2 precision
  shift 2
  for precision in half 8bit; do
    picture "s11-$id-$sun-$precision" "${s11[@]}" --model bruneton --table-precision "$precision" --sun-zenith-deg "$sun" "$@"
  done
}
begin
precisions 5-4 30 --view valley "${small[@]}"
precisions 5-4 65 --view valley "${small[@]}"
figure "5-4: tables of 16 and of 8 bits, midday and afternoon" "Hardly different." \
  "bruneton, 16 bits, midday" "8 bits, midday" "16 bits, afternoon" "8 bits, afternoon"
begin
precisions 5-5 89 --view sunset "${small[@]}"
precisions 5-5 93 --view sunset "${small[@]}"
figure "5-5: tables of 16 and of 8 bits toward a low sun" \
  "8 bits show bands, the more the lower the sun. Here, where 255 steps reach just as far as each table's light, they come after sunset." \
  "bruneton, 16 bits, 89 deg" "8 bits, 89 deg" "16 bits, 93 deg" "8 bits, 93 deg"
text "5.2.2: memory and error of tables" \
  "Of the reference's tables, against those of full size in single precision. His 8 bits hold light, these its logarithm." \
  tables earth-clear --measure

# --- Bodare and Sandberg 2014 -----------------------------------------------------------------------------------------
bs=(--preset bodare-2014)
source_of bs14 "Bodare and Sandberg 2014: 3D tables, ozone"
begin
both bs14-20 bodare "${bs[@]}" --view sunset --sun-zenith-deg 93 --strip ozone.column=0..454:2 "${small[@]}"
figure "20: without and with ozone" "Ozone makes the twilight bluer." "bodare: 0 and 454 DU" "reference: 0 and 454 DU"

begin
both bs14-21 bodare "${bs[@]}" --view sunset --sun-zenith-deg 80 --second-sun 70,25,0.5 "${small[@]}"
both bs14-21-3000K bodare "${bs[@]}" --view sunset --sun-zenith-deg 80 --second-sun 70,25,0.5 --second-sun-temperature-k 3000 "${small[@]}"
figure "21: two suns" "Each adds its light with its own direction, and its own colour." \
  "bodare" "reference" "bodare, the second sun of 3000 K" "reference, the second sun of 3000 K"

begin
picture bs14-22 "${bs[@]}" --view sunset --sun-zenith-deg 75 --strip rayleigh.scattering=1.279e-6..1.279e-4:3:geometric \
  --rows model=bodare,reference "${small[@]}"
figure "22: the air's density times 0.1, 1 and 10" "Skies of other worlds by density alone." "one exposure"

begin
picture bs14-24 "${bs[@]}" --view valley --strip sun-zenith-deg=90,88,86 --model bodare --metering each "${small[@]}"
picture bs14-24-higher "${bs[@]}" --view valley --strip sun-zenith-deg=82,75,65 --model bodare --metering each "${small[@]}"
figure "24: light on the ground" "It changes evenly over the day." "bodare; each its own exposure" "bodare"

begin
both bs14-13 bodare "${bs[@]}" --view sunset --sun-zenith-deg 86 --clouds 0.5,4000 "${small[@]}"
figure "13: clouds under a low sun" "They turn red: the sun's light is what the air lets through." "bodare" "reference"

begin
picture bs14-28 "${bs[@]}" --view valley --strip mie.scattering=2e-5..1e-3:3:geometric --rows model=bodare,reference "${strip[@]}"
figure "28: fog" "Foggy weather by parameters alone. In the thickest, bodare is darker than the reference, most where little light comes straight from the sun." "one exposure"

begin
both bs14-29 bodare "${bs[@]}" --view limb "${small[@]}"
figure "29: the limb from space" "Limb and disc without a seam." "bodare" "reference"

begin
picture bs14-11-own --model bodare "${bs[@]}" --view sunset --sun-zenith-deg 80 "${small[@]}"
picture bs14-11-from-air --model bodare:mie-from-rayleigh "${bs[@]}" --view sunset --sun-zenith-deg 80 "${small[@]}"
figure "11: aerosol with a table of its own, and from that of air" "No difference to be seen around the sun." \
  "bodare" "bodare:mie-from-rayleigh"

begin
panels bs14-23-volume in-scatter --model bodare "${bs[@]}" --view 10km --exposure 3e-4 "${small[@]}"
panels bs14-23-pixel in-scatter --model bodare "${bs[@]}" --view 10km --aerial pixel --exposure 3e-4 "${small[@]}"
panels bs14-23-reference in-scatter "${bs[@]}" --view 10km --exposure 3e-4 "${small[@]}"
figure "23: light of the air alone, from the volume and step by step" "No seam at the horizon. His right picture has 4 samples of single scattering; here both have 16 and the gathered light." \
  "bodare, the volume" "bodare, for each pixel" "reference"

begin
without_ozone=$scratch/without-ozone.json
"$skyfit" presets bodare-2014 | sed 's/"column_du": 454/"column_du": 0/' >"$without_ozone"
grep -q '"column_du": 0' "$without_ozone"
commands+=$'skyfit presets bodare-2014 | sed \'s/"column_du": 454/"column_du": 0/\' >without-ozone.json\n'
mountains=(--latitude-deg 43.6 --longitude-deg -27.1 --above-ground-m 300 --heading-deg 60 --pitch-deg 11 --sun-zenith-deg 72
  --sun-azimuth-deg 48 --exposure 1.3e-4 "${small[@]}")
panels bs14-27-1 in-scatter --preset "$without_ozone" --orders 1 "${mountains[@]}"
panels bs14-27-2 in-scatter "${bs[@]}" --orders 1 "${mountains[@]}"
panels bs14-27-3 in-scatter --model bodare "${bs[@]}" "${mountains[@]}"
picture bs14-27-4 --model bodare "${bs[@]}" --atmosphere off --glare none "${mountains[@]}"
picture bs14-27-5 --model bodare "${bs[@]}" --glare none "${mountains[@]}"
picture bs14-27-6 --model bodare "${bs[@]}" --clouds 0.4,6000 "${mountains[@]}"
figure "27: a frame in six steps" "Each step adds its part. Without ozone the light is yellower; all orders make it bluer and brighter." \
  "light of the air, scattered once, without ozone (reference)" "with ozone (reference)" "all orders (bodare)" \
  "the ground without air" "the ground in the air" "clouds, and the glare of the sun"

# --- Nielsen 2003 -----------------------------------------------------------------------------------------------------
source_of n03 "Nielsen 2003: closed form with mean densities"
n03=(--preset nielsen-2003)
begin
plotted n03-5-2 --figure mean-density
figure "5.2: the mean of the densities and the density at the mean height" "The latter is nearer to the integral." "ground at 1500 m"
begin
picture n03-7-1 "${n03[@]}" --view ground --azimuth-deg 90 --sun-zenith-deg 80 --pitch-deg 55 --field-of-view-deg 100 \
  --strip model=hoffman-preetham,nielsen,reference "${small[@]}"
figure "3.8 and 7.1: the sky at 90 deg from a low sun" \
  "By Rayleigh's phase function the sky of hoffman-preetham is too dark in the middle (3.8). His own phase function takes the dark part away (7.1), more than many scatterings in the reference do." \
  "one exposure"
begin
captions=()
for altitude in 2 16e3 30e3; do
  both "n03-7-3-$altitude" nielsen "${n03[@]}" --view away --altitude-m "$altitude" --sun-zenith-deg 40 --pitch-deg 15 "${small[@]}"
  captions+=("$altitude m, nielsen" "reference")
done
figure "7.3: the sky over height" "The zenith darkens with height, the horizon stays white." "${captions[@]}"
text "7.3: the luminance" "90 deg from the sun, by his model." \
  sky "${n03[@]}" --model nielsen --sun-zenith-deg 40 --view-zenith-deg 0,30,60,80,89 --azimuth-deg 90 --altitude-m 0,16000,30000
begin
picture n03-7-4 "${n03[@]}" --view ground --sun-zenith-deg 60 --pitch-deg 22 --glare none --strip mie.scattering=3.968e-6,5.555e-5 \
  --rows model=nielsen,reference --metering each "${small[@]}"
figure "7.4: the sky toward the sun" \
  "The sky is brighter toward the sun: little in his clearest air, strongly in his haziest. His rise is steeper: his aerosol scatters more forward the hazier, by a formula not known here, where it keeps the g of 0.444." \
  "each its own exposure; the sun without glare"
begin
both n03-7-5 nielsen:sun-through-sky "${n03[@]}" --view sunset --sun-zenith-deg 88 "${small[@]}"
figure "7.5: sunset" "Bright round the sun. His text lets the sun's light fall, but does not say how: here it is what his sky lets through, one colour for all of the sky, which has no red along the horizon of its own." \
  "nielsen:sun-through-sky" "reference"
begin
picture n03-7-6 "${n03[@]}" --view 10km --altitude-m 3500 --sun-zenith-deg 50 --field-of-view-deg 20 --view-zenith-deg 92 \
  --strip model=nielsen,reference "${small[@]}"
figure "7.6: mountains by day" \
  "Shadows of near ranges are blue, the farthest peaks yellow to white." \
  "one exposure"
begin
for model in nielsen nielsen:mean-height; do
  picture "n03-7-7-${model//:/-}" --model "$model" "${n03[@]}" --view 10km --strip mie.scattering=3.968e-6..5.555e-5:3 "${strip[@]}"
done
figure "7.7: the mean of the densities, and the density at the mean height" "The latter sees farther down: density falls exponentially, so that the mean of two of them is larger." \
  "nielsen, haze 5e-4 to 7e-3" "nielsen:mean-height"
begin
picture n03-7-8 "${n03[@]}" --view 10km --strip altitude-m=4e3,8e3,12e3,16e3 --rows model=nielsen,reference "${strip[@]}"
figure "7.8: visibility over height" "The ground below is seen through ever thinner air, from ever farther away, and the horizon stays white." \
  "one exposure"
begin
both n03-7-9 nielsen "${n03[@]}" --view 10km --strip mie.scattering=3.968e-6..5.555e-5:4 "${strip[@]}"
figure "7.9: haze" "The range is clear and slightly blue, at last it is gone." "nielsen, haze 5e-4 to 7e-3" "reference"
begin
for azimuth in 0 180; do
  both "n03-7-10-$azimuth" nielsen:sun-through-sky "${n03[@]}" --view valley --sun-zenith-deg 84 --azimuth-deg "$azimuth" "${small[@]}"
done
figure "7.10: toward a low sun and away from it" "Toward it the sky is yellow, by the aerosol; away from it the air is clear. The blue of his figure away from the sun is light that was scattered more than once, which the reference has." \
  "toward, nielsen:sun-through-sky" "toward, reference" "away, nielsen:sun-through-sky" "away, reference"
begin
picture n03-7-11 "${n03[@]}" --view 10km --strip altitude-m=4e3,10e3 --rows model=nielsen:sun-through-sky,hoffman-preetham "${small[@]}"
figure "7.11: variable and constant density" "From 10 km, constant density hides what is seen through thin air. Both have the light of the sun that their sky lets through." \
  "one exposure"

# --- O'Neil 2005 ------------------------------------------------------------------------------------------------------
on=(--preset oneil-2005)
source_of o05 "O'Neil 2005: samples along the ray"
begin
for view in space limb ground sunset; do
  both "o05-16-1-$view" oneil "${on[@]}" --view "$view" "${small[@]}"
done
figure "16-1: from space to sunset" "Plausible at every height; single scattering leaves the sunset too dark." \
  "space, oneil" "space, reference" "limb, oneil" "limb, reference" "ground, oneil" "ground, reference" "sunset, oneil" "sunset, reference"

begin
captions=()
for samples in 3 5 10 50; do
  picture "o05-samples-$samples" --model "oneil:samples=$samples" "${on[@]}" --view ground --sun-zenith-deg 75 --exposure 3e-4 "${small[@]}"
  captions+=("$samples samples")
done
figure "Samples of a ray" "More samples are brighter, by 7 % toward the zenith from 3 on, and converge." "${captions[@]}"
begin
demo=(--model oneil:samples=3:isotropic-air:no-shadow "${on[@]}" --exposure 3e-4 "${small[@]}")
picture o05-16-4-clip "${demo[@]}" --view sunset --tone clip
picture o05-16-4-exponential "${demo[@]}" --view sunset --tone exponential
figure "16-4: without and with a tone curve" "Without it the sky about the sun is cut off. The model is that of his demo." "--tone clip" "--tone exponential"

# --- Schafhitzel, Falk and Ertl 2007 ----------------------------------------------------------------------------------
source_of sfe07 "Schafhitzel, Falk and Ertl 2007: 3D texture, Earth and Mars"
earth=(--preset schafhitzel-2007-earth)
begin
both sfe07-4a schafhitzel "${earth[@]}" --view space "${small[@]}"
both sfe07-4b schafhitzel "${earth[@]}" --view orbit --sun-zenith-deg 80 "${small[@]}"
figure "4a, 4b: the Earth from space, and after sunrise from high above" "A blue limb; long paths are tinted near the terminator. The thin arc on the night limb from space is the model's: its table leaves the azimuth between view and sun out, so a ray that leads away from the sun has the light of one toward it." \
  "space, schafhitzel" "space, reference" "orbit, schafhitzel" "orbit, reference"
begin
picture sfe07-4d "${earth[@]}" --view valley --strip sun-zenith-deg=89,78,40 --rows model=schafhitzel,reference --metering each "${small[@]}"
figure "4c to 4f: mountains at sunrise, in the morning, at midday" "The light follows the sun's angle." "each its own exposure"
begin
both sfe07-4g schafhitzel --preset schafhitzel-2007-mars --view space "${small[@]}"
both sfe07-4h schafhitzel --preset schafhitzel-2007-mars --view valley "${small[@]}"
figure "4g, 4h: Mars without dust, from space and in a valley" "Another colour by density and wavelengths alone." \
  "space, schafhitzel" "space, reference" "valley, schafhitzel" "valley, reference"

# --- what is missing --------------------------------------------------------------------------------------------------
cat >>"$page" <<'HTML'
<h2 id="missing">What is not shown</h2>
<ul>
<li>Sperlhofer: the noise of the terrain (4-11, 4-12) and the mask of what is clipped (4-41).</li>
<li>Bodare and Sandberg: the update over frames as frames (12; <code>--update-frames</code> draws them); the seam of the difference of
two rays (16, 18): <code>bruneton:half-inscatter</code> takes this difference, but has no line at the horizon of this atmosphere.
Figure 25 is in the notebook <code>03_models_side_by_side</code>.</li>
<li>Nielsen: his other plots (2.5, 5.1, 5.3, 5.4), the edge of the world (7.14), which a whole planet does not have, and clipping
(7.15).</li>
<li>All: times on the machines of their day.</li>
</ul>
</body>
</html>
HTML

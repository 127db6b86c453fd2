#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The report in a headless browser: it opens offline without errors and has every point. Skipped (77) where there is no
# browser. REPORT_SCREENSHOT=FILE keeps a picture of the page.
set -euo pipefail
stroma=$1

browser=
for name in chromium-headless-shell chromium chromium-browser google-chrome; do
  if command -v "$name" > /dev/null; then browser=$name; break; fi
done
if [[ -z $browser ]]; then
  echo "skipped: there is no chromium here (Debian: chromium-headless-shell)"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat > fall.xml << 'END'
<Node name="root" dt="1 ms" gravity="0 -10 0" duration="0.1 s">
  <Node name="ball">
    <EulerExplicitSolver name="solver" substeps="1"/>
    <MechanicalObject name="particles" position="0 0 0   1 0 0   0 1 0   0 0 1"/>
    <UniformMass name="mass" totalMass="1 kg"/>
    <Monitor name="height" component="y"/>
  </Node>
</Node>
END
cat > study.xml << 'END'
<Study title="Fall &lt;script>alert(1)&lt;/script>" text="&lt;b>plain&lt;/b> &amp; simple" scene="fall.xml" repeats="2">
  <Measure name="height &lt;/script>" monitor="/ball/height" reference="-50 mm"/>
  <Axis name="step">
    <Point name="4" h="4 ms"><Set attribute="/.dt" value="4 ms"/></Point>
    <Point name="2" h="2 ms"><Set attribute="/.dt" value="2 ms"/></Point>
    <Point name="1" h="1 ms"><Set attribute="/.dt" value="1 ms"/></Point>
  </Axis>
  <Method name="free"/>
  <Method name="&lt;img src=x onerror=alert(1)>">
    <Insert into="/ball"><RestShapeSpringsForceField name="s" all="true" stiffness="0.01"/></Insert>
  </Method>
  <Method name="wild">
    <Insert into="/ball"><RestShapeSpringsForceField name="s" all="true" stiffness="1e15"/></Insert>
  </Method>
  <Published name="elsewhere" ms="18" source="a paper"/>
  <Budget error="5 %" ms="1 ms"/>
</Study>
END
"$stroma" study study.xml --out out > /dev/null 2> log.txt || [[ $? == 3 ]]

open_page() {
  timeout 60 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$work/profile" \
    --host-resolver-rules="MAP * ~NOTFOUND" --window-size=1300,2600 --virtual-time-budget=10000 --enable-logging=stderr --v=0 \
    "$@" "file://$work/out/report.html"
}
open_page --dump-dom > dom.html 2> console.txt
if grep -E 'CONSOLE' console.txt; then echo "FAIL  the console has messages"; exit 1; fi
count() { grep -o "$1" dom.html | wc -l; }
# 6 good points in each of the 3 plots
[[ $(grep -o '<html[^>]*data-points="[0-9]*"' dom.html | grep -o '[0-9]*"$') == '18"' ]]
[[ $(count 'data-points="6"') == 3 ]]
[[ $(count '<tr[^>]*data-id=') == 9 ]]
[[ $(count '<canvas') == 10 ]]  # and the stages, and 6 pictures
[[ $(count '<img') == 0 ]]
grep -q '"order":\(1\.00\|0\.99\)' out/report.html
grep -q 'diverged' dom.html
open_page --screenshot="$work/page.png" > /dev/null 2>&1
[[ $(stat -c %s page.png) -gt 20000 ]]
if [[ -n ${REPORT_SCREENSHOT:-} ]]; then cp page.png "$REPORT_SCREENSHOT"; fi
echo "ok: $browser"

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Whole studies through the command line: tables, exit codes, what goes wrong, stopping and going on.
stroma=$1
# shellcheck source=tests/cli/expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../cli/expect.sh"
study() { "$stroma" study "$@" --cache cache; }
# the columns of a table that do not depend on the clock: question to error, and the states' hashes
answers() { cut -d, -f1-7 "$1/results.csv"; grep -o '"state_hash": "[0-9a-f]*"' "$1/results.json"; }

mkdir scenes
cat > scenes/fall.xml << 'END'
<Node name="root" dt="1 ms" gravity="0 -10 0" duration="0.5 s">
  <Node name="ball">
    <EulerExplicitSolver name="solver" substeps="1"/>
    <MechanicalObject name="particles" position="0 0 0   1 0 0   0 1 0   1 1 0   0 0 1   1 0 1   0 1 1   1 1 1"/>
    <UniformMass name="mass" totalMass="8 kg"/>
    <Monitor name="height" component="y"/>
  </Node>
</Node>
END
# symplectic Euler falls g dt t / 2 too far: order 1
steps='<Axis name="step">
  <Point name="4" h="4 ms"><Set attribute="/.dt" value="4 ms"/></Point>
  <Point name="2" h="2 ms"><Set attribute="/.dt" value="2 ms"/></Point>
  <Point name="1" h="1 ms"><Set attribute="/.dt" value="1 ms"/></Point></Axis>'
spring='<Insert into="/ball"><RestShapeSpringsForceField name="spring" all="true" stiffness="STIFF"/></Insert>'
cat > fall.xml << END
<Study title="Fall &lt;&amp;&gt; \$5" cite="Galilei" scene="scenes/fall.xml" repeats="2">
  <Measure name="height" monitor="/ball/height" reference="-1250 mm"/>
  <Measure name="field" state="/ball/particles" points="0.5 0.5 0.5" reference="@fine"/>
  <ReferenceRun name="fine"><Set attribute="/.dt" value="0.5 ms"/></ReferenceRun>
  $steps
  <Method name="no spring"/>
  <Method name="soft spring">${spring/STIFF/0.01}</Method>
  <Budget error="0.5 %" ms="1 ms"/>
</Study>
END

expect 0 "a study" study fall.xml --out whole
holds "  says which is the fastest" grep -q "At 0.5 % error the fastest is" out.txt
holds "  writes a page" test -s whole/report.html
holds "  that loads nothing from elsewhere" bash -c '! grep -Eq "(src|href)=\"(http|//)" whole/report.html'
holds "  and says what it is in plain text" grep -q '<title>Fall &lt;&amp;&gt; $5</title>' whole/report.html
holds "  fits order 1" bash -c 'grep -o "\"order\": [0-9.]*" whole/results.json | head -1 | grep -Eq "(1\.00|0\.99)"'
holds "  has six rows" test "$(wc -l < whole/results.csv)" = 7
holds "  keeps the reference run in the cache" bash -c 'ls cache/reference-fine-*.json'
scene=$(ls "$PWD"/whole/scenes/no-spring-step-4-*.xml)
expect 0 "the scene that was run is there to be run" "$stroma" run "$scene" --data scenes --steps 3 --out "$work/by_hand"
expect 0 "the same again" study fall.xml --out whole
holds "  redoes nothing" grep -q "7 runs, 7 of them done before" err.txt
before=$(answers whole)
expect 0 "from the start" study fall.xml --out whole --again
holds "  gives the same bits" test "$before" = "$(answers whole)"
expect 0 "--json prints results.json" study fall.xml --out whole --json
holds "  the same" cmp out.txt whole/results.json

# an input file that changes is another run
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > scenes/mesh.obj
sed 's|<Monitor|<MeshOBJLoader name="mesh" filename="mesh.obj"/>\n<Monitor|' scenes/fall.xml > scenes/meshed.xml
echo '<Study title="Mesh" scene="scenes/meshed.xml" repeats="2"><Measure name="e" of="energy"/></Study>' > mesh.xml
expect 0 "a study of a scene with a mesh" study mesh.xml --out mesh
expect 0 "again" study mesh.xml --out mesh
holds "  it was done before" grep -q "1 of them done before" err.txt
sed -i 's/v 1 0 0/v 2 0 0/' scenes/mesh.obj
expect 0 "with another mesh" study mesh.xml --out mesh
holds "  it is run" grep -q "1/1" err.txt

# measures that share a name: each method is compared with its own reference
cat > shared.xml << 'END'
<Study title="Shared" scene="scenes/fall.xml" repeats="2">
  <Measure name="height" monitor="/ball/height" reference="-1250 mm" source="by hand" method="free"/>
  <Measure name="height" monitor="/ball/height" reference="-2.5 m" source="by head" method="half"/>
  <Measure name="height off" monitor="/ball/height" reference="0" scale="1 m" method="free"/>
  <Measure name="outside" state="/ball/particles" points="0 9 0" reference="0 1 0" method="free"/>
  <Method name="free"/>
  <Method name="half"/>
</Study>
END
expect 0 "measures that share a name" study shared.xml --out shared
holds "  are compared with their own references" bash -c 'grep -q "^,free,.*,done,,0.00[0-9]*," shared/results.csv && grep -q "^,half,.*,done,,0.4[0-9]*," shared/results.csv'
holds "  and both are told" bash -c 'grep -q "by hand" shared/results.json && grep -q "by head" shared/results.json'
holds "a point outside the body is told" grep -q "the point 0 9 0 is outside the body" shared/results.json

# stopping: the time of a variation is mostly its repeats, so there is time to be hit
sed 's/repeats="2"/repeats="20"/' fall.xml > slow.xml
study slow.xml --out slow_whole > /dev/null 2>&1
"$stroma" study slow.xml --out killed --cache cache2 > /dev/null 2>&1 &
parent=$!
for (( i = 0; i < 200; ++i )); do
  [[ $(ls killed/results 2> /dev/null | grep -vc part) -ge 2 ]] && break
  sleep 0.05
done
child=$(cat /proc/$parent/task/$parent/children 2> /dev/null)
kill -9 $parent
wait $parent 2> /dev/null
sleep 0.2
# (one that has ended may stay as a zombie where nobody reaps)
for one in $child; do
  holds "killed: its process ends with it" bash -c "! grep -q '^State:[[:space:]]*[RSD]' /proc/$one/status 2> /dev/null"
done
expect 0 "goes on after kill -9" "$stroma" study slow.xml --out killed --cache cache2
holds "  where it was" grep -Eq "7 runs, [1-6] of them done before" err.txt
holds "  and ends with the same table" test "$(answers killed)" = "$(answers slow_whole)"

"$stroma" study slow.xml --out interrupted --cache cache2 --again > out.txt 2> err.txt &
parent=$!
for (( i = 0; i < 200; ++i )); do
  [[ $(ls interrupted/results 2> /dev/null | grep -vc part) -ge 1 ]] && break
  sleep 0.05
done
kill -INT $parent
wait $parent
holds "interrupted: exit code 130" test $? = 130
holds "  reports what is there" grep -q "not run" interrupted/results.csv

# one that diverges and one that takes too long leave the others alone
cat > trouble.xml << END
<Study title="Trouble" scene="scenes/fall.xml" repeats="2" timeout="2 s">
  <Measure name="height" monitor="/ball/height" reference="-1250 mm"/>
  <Method name="good"/>
  <Method name="wild">${spring/STIFF/1e12}</Method>
  <Method name="endless"><Set attribute="/.dt" value="1 ns"/></Method>
  <Method name="massless"><Set attribute="/ball/mass.totalMass" value="1e-320"/></Method>
</Study>
END
expect 3 "a study with trouble" study trouble.xml --out trouble
holds "  the good one is done" grep -q "^,good,.*,done," trouble/results.csv
holds "  the wild one diverged, at a step" grep -Eq "^,wild,.*,diverged,.*at step [0-9]+" trouble/results.csv
holds "  the endless one timed out" grep -q "^,endless,.*,timed out,not done after 2 s" trouble/results.csv
expect 3 "again" study trouble.xml --out trouble
holds "  tries what timed out, and nothing else" grep -q "1/1  endless" err.txt

# a process that crashes
"$stroma" study slow.xml --out crashed --cache cache > out.txt 2> err.txt &
parent=$!
child=
for (( i = 0; i < 200 && ${#child} == 0; ++i )); do
  sleep 0.02
  child=$(cat /proc/$parent/task/$parent/children 2> /dev/null)
done
# one that has only just been started may not be the program yet
sleep 0.1
child=$(cat /proc/$parent/task/$parent/children 2> /dev/null)
kill -SEGV $child
wait $parent
holds "a crash: exit code 3" test $? = 3
holds "  is told" grep -q "crashed,.*signal 11" crashed/results.csv
expect 0 "  and tried again" study slow.xml --out crashed
holds "  with the same table" test "$(answers crashed)" = "$(answers slow_whole)"

if (( $(nproc) > 1 )); then
  expect 0 "two side by side" study fall.xml --out pair --jobs 2
  holds "  gives the same bits" test "$before" = "$(answers pair)"
  holds "  and says so" grep -q '"side_by_side": 2' pair/results.json
fi

expect 1 "no study" "$stroma" study
expect 1 "more jobs than cores" study fall.xml --jobs 1000
expect 2 "missing study" study nowhere.xml
expect 2 "missing scene" study <(echo '<Study title="x" scene="no.xml"><Measure name="a" of="energy"/></Study>')
echo '<Study title="x" scene="scenes/fall.xml"><Measure name="a" monitor="/ball/heigth"/></Study>' > wrong.xml
expect 2 "misspelt monitor" study wrong.xml
holds "  with its place" grep -Eq "^wrong.xml:1:6[0-9]: error" err.txt
holds "  and the nearest name" grep -q "did you mean 'height'" err.txt
touch file
expect 4 "a folder that cannot be made" study fall.xml --out file/below
expect 0 "help" "$stroma" study --help

report

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Exit codes, files, checkpoints and interrupts of the command line.
stroma=$1
# shellcheck source=tests/cli/expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

same() { [[ -n $1 && $1 == "$2" ]]; }
hash_in() { grep -o '"state_hash":"[0-9a-f]\{16\}"' "$1"; }

cat > fall.xml << 'END'
<Node name="root" dt="0.001" gravity="0 -9.81 0" duration="0.5 s">
  <Node name="ball">
    <EulerExplicitSolver name="solver"/>
    <MechanicalObject name="particles" position="0 0 0   10 0 0 mm" velocity="1 2 3"/>
    <UniformMass name="mass" totalMass="20 g"/>
  </Node>
</Node>
END

expect 1 "no command" "$stroma"
expect 1 "unknown command" "$stroma" rum fall.xml
holds "  names the nearest" grep -q "did you mean 'run'" err.txt
expect 1 "unknown option" "$stroma" run fall.xml --stepz 3
expect 1 "steps and time exclude each other" "$stroma" run fall.xml --steps 3 --time 1
expect 1 "time in millimetres" "$stroma" run fall.xml --time 5mm
expect 0 "help" "$stroma" run --help
expect 0 "version" "$stroma" --version

expect 2 "missing scene" "$stroma" run nowhere.xml
expect 2 "misspelt --set" "$stroma" run fall.xml --set /ball/mass.totalMas=1
holds "  names the nearest" grep -q "did you mean 'totalMass'" err.txt
expect 2 "check of a broken scene" "$stroma" check fall.xml nowhere.xml
expect 0 "check" "$stroma" check fall.xml
expect 0 "plan" "$stroma" plan fall.xml
holds "  shows the call" grep -q "solve  /ball/solver" out.txt
holds "  shows the particles" grep -q "(EulerExplicitSolver): 2 particles" out.txt

expect 0 "run for the scene's duration" "$stroma" run fall.xml --json
holds "  makes 500 steps" grep -q '"steps":500,' out.txt
for key in scene particles steps dt threads wall_ms_per_step cpu_ms_per_step stages real_time_factor load_ms \
           peak_memory_mb modules limiters state_hash monitors files; do
  holds "  JSON has $key" grep -q "\"$key\":" out.txt
done
holds "  and nothing else is printed" test "$(wc -l < out.txt)" -eq 1
holds "  nor a folder made" test ! -e out
whole=$(hash_in out.txt)
expect 0 "two threads" "$stroma" run fall.xml --json --threads 2
holds "  give the same bits" same "$whole" "$(hash_in out.txt)"

begun=$(date +%s%N)
expect 0 "real time" "$stroma" run fall.xml --real-time --json
holds "  takes as long as the scene says" test $(( $(date +%s%N) - begun )) -ge 490000000
holds "  gives the same bits where there is no hand" same "$whole" "$(hash_in out.txt)"

expect 0 "checkpoint" "$stroma" run fall.xml --time "250 ms" --checkpoint-every 0.25 --out results
holds "  is written" test -s results/fall.checkpoint
expect 0 "resume" "$stroma" run fall.xml --resume results/fall.checkpoint --json
holds "  makes the other 250 steps" grep -q '"steps":250,"last_step":500,' out.txt
holds "  and ends with the same bits" same "$whole" "$(hash_in out.txt)"
expect 4 "resume from nothing" "$stroma" run fall.xml --resume nowhere.checkpoint
expect 4 "resume from what is no checkpoint" "$stroma" run fall.xml --resume fall.xml
expect 4 "resume with other values" "$stroma" run fall.xml --resume results/fall.checkpoint \
  --set /ball/mass.totalMass=1
expect 4 "output into a file" "$stroma" run fall.xml --out fall.xml/results

sed 's/velocity="1 2 3"/velocity="1e308 0 0"/; s/dt="0.001"/dt="100"/' fall.xml > diverge.xml
expect 3 "divergence" "$stroma" run diverge.xml --steps 10 --json --out results
holds "  names the particle" grep -q "particle 0" err.txt
holds "  is in the JSON" grep -q '"diverged":{"component":"/ball' out.txt
holds "  leaves the last good state" test -s results/last_good.checkpoint

"$stroma" run fall.xml --time 1e6 --out results > out.txt 2> err.txt &
pid=$!
sleep 0.5
kill -INT $pid
wait $pid
holds "an interrupt ends with 130" test $? -eq 130
holds "  and a summary" grep -q interrupted out.txt

expect 2 "view of no scene" "$stroma" view nowhere.xml --port 0
expect 4 "view at no address" "$stroma" view fall.xml --address nowhere
expect 1 "view at no port" "$stroma" view fall.xml --port 99999
expect 1 "picture of no time" "$stroma" render fall.xml --out fall.png --at -1
expect 4 "picture without a browser" "$stroma" render fall.xml --out fall.png --browser /nowhere

expect 0 "components" "$stroma" components
expect 0 "one component" "$stroma" components MechanicalObject
holds "  shows units" grep -q "velocity  (list of 3 numbers each, m/s" out.txt
expect 1 "unknown component" "$stroma" components MechanicalObjet
holds "  names the nearest" grep -q "did you mean 'MechanicalObject'" err.txt
expect 0 "reference pages" "$stroma" components --markdown pages
holds "  are written" test -s pages/UniformMass.md
expect 0 "schema" "$stroma" schema --out stroma.xsd
if command -v xmllint > /dev/null; then
  expect 0 "  accepts a valid scene" xmllint --noout --schema stroma.xsd fall.xml
  sed 's/totalMass=/totalMas=/' fall.xml > misspelt.xml
  expect 3 "  refuses a misspelt one" xmllint --noout --schema stroma.xsd misspelt.xml
fi

report

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Suites through the command line: tables, exit codes, what goes wrong; and criteria in single runs.
stroma=$1
# shellcheck source=tests/cli/expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../cli/expect.sh"

# scene NAME CHECK
scene() {
  cat > "$1.xml" << END
<Node name="root" dt="10 ms" gravity="0 -10 0" duration="1 s">
  <Node name="ball">
    <EulerExplicitSolver name="solver" substeps="1"/>
    <MechanicalObject name="particles" position="0 0 0  1 0 0"/>
    <UniformMass name="mass" totalMass="1 kg"/>
  </Node>
  $2
</Node>
END
}
scene fall '<StabilityCheck name="check" maxSpeed="11 m/s" finalTime="1 s"/>'
scene fast '<StabilityCheck name="check" maxSpeed="9 m/s"/>'
scene unchecked ''

expect 0 "a run that meets its criteria" "$stroma" run fall.xml
holds "  says so" grep -q "/check.maxSpeed .*passed  10 m/s at step 100" out.txt
expect 5 "a run that misses one" "$stroma" run fast.xml
holds "  names place, criterion, measure, step and bound" \
  grep -q 'fast.xml:7:[0-9]*: error: /check: maxSpeed is 10 m/s at step 100 (1 s); bound at most 9 m/s' err.txt
expect 5 "  also with --json" "$stroma" run fast.xml --json
holds "  which has the criterion" grep -q '"criterion":"maxSpeed","passed":false' out.txt
expect 5 "a run that does not reach its time" "$stroma" run fall.xml --steps 50

cat > good.xml << 'END'
<StabilitySuite title="Falls &amp; more">
  <Method name="own" default="true" quick="true"/>
  <Method name="fixed"><Insert into="/ball"><FixedProjectiveConstraint indices="0 1"/></Insert></Method>
  <Case name="fall" scene="fall.xml"/>
  <Case name="again" scene="fall.xml"><NotApplicable method="fixed" reason="it does not fall"/></Case>
  <HeldElsewhere name="flying" test="another-test"/>
</StabilitySuite>
END
sed -e 's/fall.xml"\/>/fast.xml"\/>/' good.xml > bad.xml
sed -e 's/fall.xml"\/>/unchecked.xml"\/>/' good.xml > empty.xml
sed -e '4s/name="fall"/name="falling" colour="red"/' good.xml > wrong.xml

expect 0 "a suite" "$stroma" stability good.xml --out good --jobs 1
holds "  ends with its count" test "$(tail -1 out.txt)" = "2 cases: 2 passed, 0 failed"
holds "  gives the reason where nothing applies" grep -q "again, fixed: it does not fall" out.txt
holds "  names what others hold" grep -q "flying: another-test" out.txt
holds "  writes a page" grep -q "<h1>Falls &amp; more</h1>" good/table.html
holds "  that loads nothing from elsewhere" bash -c '! grep -Eq "(src|href)=\"(http|//)" good/table.html'
holds "  writes results" grep -q '"format": "stroma-stability 1"' good/results.json
expect 0 "  the scenes that were run are there to be run" \
  "$stroma" run good/scenes/fall--fixed.xml --data .
expect 0 "its quick part" "$stroma" stability good.xml --out quick --quick
holds "  has one method" test "$(tail -1 out.txt)" = "2 cases: 2 passed, 0 failed"
expect 5 "a case that fails" "$stroma" stability bad.xml --out bad
holds "  is named with what was measured" grep -q "FAIL  fall, own: maxSpeed 10 m/s at step 100" out.txt
holds "  and counted" test "$(tail -1 out.txt)" = "2 cases: 1 passed, 1 failed"
expect 5 "a scene without criteria" "$stroma" stability empty.xml --out empty
holds "  fails, since it could not" grep -q "invalid: the scene has no criterion" out.txt
expect 2 "a suite with a mistake" "$stroma" stability wrong.xml --out wrong
holds "  which is shown" grep -q "wrong.xml:4:24: error: Case: unknown attribute 'colour'" err.txt
expect 0 "--check reads it all" "$stroma" stability good.xml --check
expect 2 "  and finds mistakes" "$stroma" stability wrong.xml --check
expect 1 "no such case" "$stroma" stability good.xml --case nothing --out none
expect 1 "no suite at all" "$stroma" stability
expect 2 "a file that is not there" "$stroma" stability nowhere.xml

report

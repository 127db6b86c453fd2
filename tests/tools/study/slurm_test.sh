#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The job array: its syntax, each of its tasks as Slurm would start it, and merging.
set -euo pipefail
stroma=$1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/it's here"
cd "$work/it's here"
cat > fall.xml << 'END'
<Node name="root" dt="1 ms" gravity="0 -10 0" duration="0.1 s">
  <Node name="ball">
    <EulerExplicitSolver name="solver"/>
    <MechanicalObject name="particles" position="0 0 0"/>
    <UniformMass name="mass" totalMass="1 kg"/>
    <Monitor name="height" component="y"/>
  </Node>
</Node>
END
cat > study.xml << 'END'
<Study title="Fall" scene="fall.xml" repeats="2">
  <Measure name="height" monitor="/ball/height" reference="-50 mm"/>
  <Axis name="step">
    <Point name="2"><Set attribute="/.dt" value="2 ms"/></Point>
    <Point name="1"><Set attribute="/.dt" value="1 ms"/></Point>
  </Axis>
</Study>
END
script=$("$stroma" study study.xml --slurm --out out)
echo "$script"
[[ $script == "sbatch "* ]]
bash -n out/job.sbatch
grep -qx '#SBATCH --array=1-2' out/job.sbatch
for task in 1 2; do SLURM_ARRAY_TASK_ID=$task bash out/job.sbatch; done
[[ $(find out/results -name '*.json' | wc -l) == 2 ]]
"$stroma" study study.xml --out out > report.txt 2> log.txt
grep -q "2 runs, 2 of them done before" log.txt
grep -q "scene, step 1" report.txt
"$stroma" study study.xml --slurm --out out 2>&1 | grep -q "everything is done"

# the real thing, where there is one
if command -v sbatch > /dev/null && timeout 5 sinfo > /dev/null 2>&1; then
  "$stroma" study study.xml --slurm --out cluster > /dev/null
  timeout 60 sbatch --wait cluster/job.sbatch
  "$stroma" study study.xml --out cluster 2>&1 > /dev/null | grep -q "2 of them done before"
  echo "run by Slurm, too"
fi
echo "ok"

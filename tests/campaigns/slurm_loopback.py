#!/usr/bin/env python3
"""A real Slurm on this machine alone runs a plan of 20 shards, one of which is requeued while it runs.

    slurm_loopback.py CONEBENCH

Starts munged, slurmctld and slurmd in a temporary folder. Exit 77 (skipped) where they are not
installed or cannot start. The merged store must equal that of one process.
"""
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

import common

SKIPPED = 77
SHARDS = 20
SOLVERS = ["gs", "newton-ac", "spg"]

CONFIGURATION = """ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=2,batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Cluster:
    def __init__(self, folder):
        for name in ("munged", "slurmctld", "slurmd", "sbatch"):
            if not shutil.which(name):
                skip(f"{name} is not installed")
        if os.geteuid() != 0:
            skip("slurmd wants root")
        self.folder = folder
        self.daemons = []

    def __enter__(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        configuration = self.folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], port=free_port(), node_port=free_port(),
            folder=self.folder, cpus=len(os.sched_getaffinity(0))))
        os.environ["SLURM_CONF"] = str(configuration)
        self.start(["munged", "--foreground", "--force", f"--key-file={key}",
                    f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munge.pid",
                    f"--log-file={self.folder}/munge.log", f"--seed-file={self.folder}/munge.seed"])
        time.sleep(1)
        self.start(["slurmctld", "-D", "-f", configuration])
        time.sleep(2)
        self.start(["slurmd", "-D", "-f", configuration])
        self.wait_until_idle()
        return self

    def start(self, command):
        self.daemons.append(subprocess.Popen([str(x) for x in command], stdout=subprocess.DEVNULL,
                                             stderr=subprocess.DEVNULL))

    def wait_until_idle(self):
        for _ in range(30):
            states = common.run(["sinfo", "-h", "-o", "%T"]).stdout
            if "idle" in states:
                return
            time.sleep(1)
        logs = "".join(p.read_text(errors="replace")[-800:] for p in self.folder.glob("*.log"))
        skip(f"the node does not come up\n{logs}")

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()


def queue():
    return common.run(["squeue", "-h", "-r", "-o", "%i %T"]).stdout.split("\n")[:-1]


def run_on_cluster(results_dir, limit_s=600):
    """Submits, requeues one running shard, waits for the end. Returns which shard that was."""
    submitted = common.run(["bash", results_dir / "slurm-submit.sh"])
    if submitted.returncode != 0:
        sys.exit(f"submit: {submitted.stderr}")
    print(submitted.stdout.strip())
    requeued = None
    for _ in range(2 * limit_s):
        jobs = queue()
        if not jobs:
            return requeued
        running = [job.split()[0] for job in jobs if job.endswith("RUNNING") and "_" in job]
        if requeued is None and running:
            time.sleep(0.3)
            if common.run(["scontrol", "requeue", running[0]]).returncode == 0:
                requeued = running[0]
        time.sleep(0.5)
    sys.exit(f"still in the queue after {limit_s} s: {jobs}")


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(dir="/tmp") as name:
        folder = pathlib.Path(name)
        with Cluster(folder):
            problems = common.make_problems(program, folder / "problems", 40)
            study = ["-p", *problems, "-s", *SOLVERS, "--tol", 1e-6, "--time-limit", "5s"]
            cluster, alone = folder / "cluster", folder / "alone"
            planned = common.run([program, "plan", *study, "--shards", SHARDS, "--slurm", "-o",
                                  cluster])
            if planned.returncode != 0:
                sys.exit(planned.stderr)
            requeued = run_on_cluster(cluster)
            if requeued is None:
                sys.exit("no shard could be requeued while it ran")
            done = common.run([program, "run", *study, "-o", alone])
            if done.returncode != 0:
                sys.exit(done.stderr)
            common.merge(program, alone)
            journals = len(list(cluster.glob("journal-*-of-20.jsonl")))
            rows = common.rows(cluster)
            print(f"{journals} journals, shard {requeued} requeued, {len(rows)} rows")
            if journals != SHARDS:
                sys.exit(f"{SHARDS} shards, but {journals} journals")
            if rows != common.rows(alone):
                sys.exit("the merged store differs from that of one process")


if __name__ == "__main__":
    main()

"""Builds the wheel for pip (PEP 517) with cmake and ninja, for the interpreter that runs pip, and with nothing else."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

TOP = pathlib.Path(__file__).resolve().parents[2]


def version():
    return re.search(r"project\(rollres VERSION ([0-9.]+)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def metadata():
    return (f"Metadata-Version: 2.1\nName: rollres\nVersion: {version()}\nRequires-Python: >=3.9\n"
            "Summary: Rolling resistance of a rigid cylinder or sphere over viscoelastic layers\nLicense: MIT\n"
            "Requires-Dist: numpy\n")


def digest(content):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")


def write_wheel(folder, files):
    """@param files contents by their names in the wheel"""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"rollres-{version()}.dist-info"
    files = {**files, f"{info}/METADATA": metadata().encode(),
             f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: rollres\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()}
    record = "".join(f"{name},{digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    name = f"rollres-{version()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(folder) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name


def run(*words):
    subprocess.run(list(map(str, words)), check=True, cwd=TOP)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """config_settings: build_folder, to build in a folder that is kept; by default a new one."""
    with tempfile.TemporaryDirectory() as scratch:
        build = pathlib.Path((config_settings or {}).get("build_folder", pathlib.Path(scratch) / "build"))
        run("cmake", "-G", "Ninja", "-S", TOP, "-B", build, "-D", "CMAKE_BUILD_TYPE=Release", "-D",
            f"Python_EXECUTABLE={sys.executable}", "-D", "ROLLRES_PYTHON=ON", "-D", "ROLLRES_BUILD_TESTS=OFF")
        run("cmake", "--build", build, "--target", "rollres_python")
        package = build / "python" / "rollres"
        return write_wheel(wheel_directory, {f"rollres/{name}": (package / name).read_bytes()
                                             for name in os.listdir(package) if name != "__pycache__"})


def get_requires_for_build_wheel(config_settings=None):
    return []

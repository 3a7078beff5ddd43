"""mitsuba_worker.py VARIANT: renders with Mitsuba 3 on request. Each line of standard input is a job as JSON:
{scene, width, height, spp, sampler, rr_depth, seed, output}; each line of standard output answers one:
{seconds, spp}, the seconds of rendering without reading the scene, or {error}. The first answer is {version}.
"""

import json
import os
import sys
import tempfile
import time

import mitsuba_scene


def main():
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)  # what Mitsuba prints is no answer
    import drjit as dr
    import mitsuba as mi

    mi.set_variant(sys.argv[1])
    mi.set_log_level(mi.LogLevel.Error)
    print(json.dumps({"version": mi.__version__}), file=answers)
    loaded = {}
    with tempfile.TemporaryDirectory() as folder:
        for line in sys.stdin:
            job = json.loads(line)
            key = json.dumps({k: v for k, v in job.items() if k not in ("seed", "output")})
            try:
                if key not in loaded:
                    transforms = mi.ScalarTransform4f().look_at, mi.ScalarTransform4f
                    size = {k: job[k] for k in ("width", "height", "spp", "sampler", "rr_depth")}
                    loaded[key] = mi.load_dict(
                        mitsuba_scene.translate(mitsuba_scene.read(job["scene"]), folder, *transforms, **size))
                scene = loaded[key]
                spp = scene.sensors()[0].sampler().sample_count()
                start = time.perf_counter()
                image = mi.render(scene, spp=spp, seed=job["seed"])
                dr.eval(image)
                dr.sync_thread()
                seconds = time.perf_counter() - start
                mi.Bitmap(image).write(job["output"])
                print(json.dumps({"seconds": seconds, "spp": spp}), file=answers)
            except Exception as error:  # to be told, whatever it is
                print(json.dumps({"error": str(error)}), file=answers)


main()

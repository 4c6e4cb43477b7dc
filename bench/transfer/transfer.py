# SPDX-License-Identifier: MIT
"""Whether detectors trained on inserted aircraft find real ones: see README.md. Called by bench/transfer.sh.

    transfer.py make   FOLDER SIGS CLIPS     projects, recipes and datasets of all arms, as far as they are missing
    transfer.py train  FOLDER ARM SEED       one detector, and what it finds in the test clips
    transfer.py report FOLDER                the table
    transfer.py bright FOLDER                how bright aircraft are before the sky in the training images of each arm
"""
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python" / "examples"))

TRAIN_IMAGES = 800
TEST_IMAGES_A_CLIP = 8
SEEDS = (1, 2, 3)
DRAWS = 200  # of the bootstrap by clip

AIRPLANES = ("airliner", "airliner-grey", "airliner-dark", "light-aircraft", "light-aircraft-grey", "light-aircraft-dark")
HELICOPTERS = ("helicopter",) + tuple(
    f"helicopter-{kind}" for kind in ("trainer", "utility", "fenestron", "medium", "military", "heavy")
)
CONTRAIL = {
    "strands": {"choice": [0, 0, 0, 2, 2, 4]},
    "length_m": {"log_uniform": [500, 8000]},
    "width_m": {"uniform": [2, 6]},
    "opacity": {"uniform": [0.2, 0.8]},
    "brightness": {"uniform": [0.3, 0.9]},
}

# What the footage does not tell is drawn, as bright as real aircraft are in the training clips: photographers have the
# sun behind them more often than not.
DRAWN_LIGHT = {
    "sun.azimuth_deg": {"normal": {"mean": 180, "deviation": 60, "low": 0, "high": 360}},
    "sun.elevation_deg": {"uniform": [5, 50]},
    "exposure": {"log_uniform": [0.7, 3]},
}
SUN_ANYWHERE = {"sun.azimuth_deg": {"uniform": [-180, 180]}, "sun.elevation_deg": {"uniform": [15, 60]}}

# Name of the arm: in what its images differ from the whole of what SIGS does. None: the footage's own aircraft.
ARMS = {
    "real": None,
    "ours": {},
    "ours as before": {"exposure_s": 1e-6, "path": True, "one": True, "no trail": True, "sun anywhere": True},
    "ours, rotors frozen": {"exposure_s": 1e-6},
    "ours, level and nose first": {"path": True},
    "ours, one helicopter": {"one": True},
    "ours, without contrails": {"no trail": True},
    "ours, the sun anywhere": {"sun anywhere": True},
    "ours, without codec, noise and blur": {"set": ["appearance.codec.match=none", "appearance.psf_sigma_px=0"]},
    "pasted plainly, a lamp": {"set": ["compositing.method=plain", "light.kind=point"], "sun anywhere": True},
}
# Of thermal clips, where neither light nor trails count.
THERMAL_ARMS = {"real": None, "ours": {"no trail": True}, "ours, lit as by day": {"no trail": True, "lit": True}}
HEAT = {
    "skin": {"log_uniform": [80, 400]},
    "engine": {"log_uniform": [100, 500]},
    "exhaust": {"log_uniform": [100, 800]},
    "glass": {"log_uniform": [50, 300]},
    "rotor": {"log_uniform": [20, 200]},
}
MIXED = {
    "a tenth of the real clips": [("real", 0.1)],
    "that tenth and ours": [("real", 0.1), ("ours", 1)],
    "all real and ours": [("real", 1), ("ours", 1)],
}


def number_of(clip):
    return int(clip.rsplit("_", 1)[1])


def kind_of(clip):
    return clip.split("_")[1].lower()


def sides_of(clips):
    """Training and test clips: runs of five numbers by turns; a test clip next to a training clip is left out."""
    train = [clip for clip in clips if (number_of(clip) - 1) // 5 % 2 == 0]
    test = [clip for clip in clips if clip not in train]
    near = {(kind_of(clip), number_of(clip) + step) for clip in train for step in (-1, 1)}
    return train, [clip for clip in test if (kind_of(clip), number_of(clip)) not in near]


def halves_of(test):
    """Every second test clip of a kind is for tuning; the others are looked at in the end."""
    tuned, untouched = [], []
    for kind in ("airplane", "helicopter"):
        of_kind = sorted(clip for clip in test if kind_of(clip) == kind)
        tuned += of_kind[0::2]
        untouched += of_kind[1::2]
    return tuned, untouched


def clips_in(folder, *kinds):
    return sorted(path.stem for path in pathlib.Path(folder).glob("*_*_*.mp4") if kind_of(path.stem) in kinds)


def is_thermal(clips):
    return all(clip.startswith("IR_") for clip in clips)


def arms_of(clips):
    return THERMAL_ARMS if is_thermal(clips) else ARMS


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")


def recipe_of(name, folder, clips_folder, clips, images, arm):
    """Images of these clips, the same frames in every arm. Without an arm: the footage alone."""
    models = pathlib.Path(__file__).resolve().parents[2] / "assets" / "models"
    flight = {
        "kind": "image_position",
        "x_percent": {"uniform": [0, 100]},
        "y_percent": {"uniform": [0, 100]},
        "size_px": {"log_uniform": [8, 128]},
        "relative_speed_mps": {"uniform": [0, 120]},
        "course_deg": {"uniform": [-180, 180]},
        "climb_deg": {"normal": {"mean": 0, "deviation": 4, "low": -15, "high": 15}},
        "nose_deg": {"normal": {"mean": 0, "deviation": 20, "low": -180, "high": 180}},
    }
    group = {
        "images": images,
        "placement": "sky",
        "per_image": 0 if arm is None else {"choice": [1, 1, 2]},
        "camera": {"attitude_deg.pitch": {"uniform": [5, 60]}},
        "light": DRAWN_LIGHT,
        "flights": [flight],
    }
    thermal = is_thermal(clips)
    if thermal:
        flight["size_px"] = {"log_uniform": [4, 64]}
        # Noise and clouds hide the sky from what tells it from land; land lies below in all of these clips.
        group["placement"] = "anywhere"
        flight["y_percent"] = {"uniform": [0, 65]}
        group["appearance"] = {"thermal.halo": {"uniform": [0.1, 0.6]}}
    if arm is None or "sun anywhere" in arm:
        group["light"] = SUN_ANYWHERE
    if arm and "exposure_s" in arm:
        group["camera"]["exposure_s"] = arm["exposure_s"]
    arm = arm or {}
    aircraft = []
    for file in AIRPLANES + (("helicopter",) * len(HELICOPTERS) if "one" in arm else HELICOPTERS):
        one = {"name": f"{file}-{len(aircraft)}", "model": {"file": str(models / file / f"{file}.obj")}}
        one["category"] = "helicopter" if file in HELICOPTERS and "path" not in arm else "airplane"
        if file.startswith("airliner") and "no trail" not in arm:
            one["contrail"] = CONTRAIL
        if thermal:
            one["heat"] = HEAT
        aircraft.append(one)
    backgrounds = [
        {
            "name": clip,
            "project": f"projects/{clip}.json",
            "footage": {"real_aircraft": str(pathlib.Path(clips_folder) / f"{clip}_gt.csv")}
            | ({"spectrum": "visible"} if "lit" in arm else {}),
            "camera": {"position_m": [0, 0, -20000], "track": {"file": ""}},
        }
        for clip in clips
    ]
    return {
        "sigs_dataset": 1,
        "name": name,
        "seed": 5,
        "settings": {"export.labels": ["coco"]},
        "backgrounds": backgrounds,
        "aircraft": aircraft,
        "videos": [group],
    }


def make(folder, sigs, clips_folder):
    folder.mkdir(parents=True, exist_ok=True)
    flown = clips_in(clips_folder, "airplane", "helicopter")
    others = clips_in(clips_folder, "bird", "drone")
    train, test = sides_of(flown)
    (folder / "projects").mkdir(exist_ok=True)
    for clip in flown + others:
        project = folder / "projects" / f"{clip}.json"
        if not project.exists():
            run(sigs, "init", pathlib.Path(clips_folder) / f"{clip}.mp4", "--out", project)
    sets = {f"test {clip}": ([clip], TEST_IMAGES_A_CLIP, None) for clip in test + others}
    sets |= {name: (train, TRAIN_IMAGES, arm) for name, arm in arms_of(flown).items()}
    for name, (clips, images, arm) in sets.items():
        out = folder / name.replace(" ", "-").replace(",", "")
        if (out / "index.json").exists():
            continue
        recipe = folder / f"{out.name}.json"
        recipe.write_text(json.dumps(recipe_of(out.name, folder, clips_folder, clips, images, arm), indent=1))
        settings = [part for setting in (arm or {}).get("set", []) for part in ("--set", setting)]
        run(sigs, "dataset", recipe, "--out", out, "--resume", *settings)
        print(f"{name}: made", flush=True)


def made_of(folder):
    """The clips that there are projects of."""
    return [path.stem for path in (folder / "projects").glob("*_*_*.json")]


def labels_of(folder, name):
    out = folder / name.replace(" ", "-").replace(",", "")
    return out / "labels" / "coco" / "all.json", out


def backgrounds_of(folder, name):
    """The clip of each image of a dataset, by the image's name."""
    index = json.loads((labels_of(folder, name)[1] / "index.json").read_text())
    return {video["name"]: video["tags"]["background"] for video in index["videos"]}


def training_images(folder, arm):
    """One Images of all parts of an arm."""
    from train_detector import Images

    whole = None
    for name, share in MIXED.get(arm, [(arm, 1)]):
        clip_of = backgrounds_of(folder, name)
        clips = sorted(set(clip_of.values()))
        # Every tenth clip, of both kinds.
        kept = set(clips if share == 1 else clips[:: round(1 / share)] + [c for c in clips if "HELI" in c][:1])
        labels, root = labels_of(folder, name)
        part = Images(labels, root, name == "real", lambda image: clip_of[image["file_name"].split("/")[0]] in kept)
        if whole is None:
            whole = part
        else:
            for field in ("ids", "names", "pixels", "boxes", "ignored"):
                getattr(whole, field).extend(getattr(part, field))
    return whole


def train_arm(folder, arm, seed):
    import torch
    from train_detector import Images, detect, train

    torch.set_num_threads(1)
    out = folder / "found" / f"{arm.replace(' ', '-').replace(',', '')}.{seed}.json"
    if out.exists():
        return
    detector = train(training_images(folder, arm), seed=seed)
    found = {}
    for path in sorted(folder.glob("test-*.json")):
        images = Images(*labels_of(folder, path.stem), find_real=True)
        found[path.stem.removeprefix("test-")] = [
            {"boxes": boxes, "found": detect(detector, pixels)} for pixels, boxes in zip(images.pixels, images.boxes)
        ]
    out.parent.mkdir(exist_ok=True)
    out.write_text(json.dumps(found))
    print(f"{arm}, seed {seed}: trained", flush=True)


def is_hit(box, found):
    """The middle of what was found lies in the middle half of the box, along both sides."""
    x, y = found[0] + found[2] / 2, found[1] + found[3] / 2
    return abs(x - box[0] - box[2] / 2) <= box[2] / 4 and abs(y - box[1] - box[3] / 2) <= box[3] / 4


def judged(images):
    """Of a clip: (score, whether it is an aircraft) of all that was found, number of aircraft, number of images."""
    scored, aircraft = [], 0
    for image in images:
        left = list(image["boxes"])
        aircraft += len(left)
        for score, box in image["found"]:
            hit = next((one for one in left if is_hit(one, box)), None)
            if hit is not None:
                left.remove(hit)
            scored.append((score, hit is not None))
    return scored, aircraft, len(images)


def average_precision(clips):
    scored = sorted((pair for one in clips for pair in one[0]), reverse=True)
    aircraft = sum(one[1] for one in clips)
    hits = np.cumsum([hit for _, hit in scored])
    precision = hits / np.arange(1, len(hits) + 1)
    precision = np.maximum.accumulate(precision[::-1])[::-1]  # the best at this recall or more
    return float(np.sum(precision[[hit for _, hit in scored]]) / aircraft) if aircraft else float("nan")


def recall_at_one_false_alarm(clips):
    scored = sorted((pair for one in clips for pair in one[0]), reverse=True)
    false = np.cumsum([not hit for _, hit in scored])
    hits = np.cumsum([hit for _, hit in scored])
    within = np.searchsorted(false, sum(one[2] for one in clips), side="right")
    return hits[within - 1] / max(1, sum(one[1] for one in clips)) if within else 0.0


def of_size(images, least_px):
    """The same images with aircraft of at least that size; what is found at smaller ones counts neither way."""
    kept = []
    for image in images:
        small = [box for box in image["boxes"] if max(box[2:]) < least_px]
        found = [one for one in image["found"] if not any(is_hit(box, one[1]) for box in small)]
        kept.append({"boxes": [box for box in image["boxes"] if max(box[2:]) >= least_px], "found": found})
    return kept


def share_reported(run, clips, others):
    """Of birds or drones with a box, the share that is reported, at the score from which on 0.8 of the aircraft are."""
    hits = sorted((score for clip in clips for score, hit in judged(run[clip])[0] if hit), reverse=True)
    aircraft = sum(judged(run[clip])[1] for clip in clips)
    least = hits[min(len(hits), round(0.8 * aircraft)) - 1] if hits else 1.0
    kept = lambda image: {**image, "found": [one for one in image["found"] if one[0] >= least]}
    judged_others = [judged([kept(image) for image in run[clip]]) for clip in others]
    return sum(hit for one in judged_others for _, hit in one[0]) / max(1, sum(one[1] for one in judged_others))


def row_of(name, runs, clips, others):
    """runs: found of each seed. The interval is of clips drawn anew, of the seeds' mean."""
    kinds = {kind: [clip for clip in clips if kind_of(clip) == kind] for kind in ("airplane", "helicopter")}
    judged_runs = [{clip: judged(run[clip]) for clip in clips} for run in runs]
    mean = lambda chosen: float(np.mean([average_precision([run[clip] for clip in chosen]) for run in judged_runs]))
    random = np.random.default_rng(1)
    draws = [mean(random.choice(clips, len(clips))) for _ in range(DRAWS)]
    heli = [mean(random.choice(kinds["helicopter"], len(kinds["helicopter"]))) for _ in range(DRAWS)]
    large = float(np.mean([average_precision([judged(of_size(run[clip], 56)) for clip in clips]) for run in runs]))
    recall = float(np.mean([recall_at_one_false_alarm([run[clip] for clip in clips]) for run in judged_runs]))
    low, high = np.quantile(draws, [0.025, 0.975])
    heli_low, heli_high = np.quantile(heli, [0.025, 0.975])
    by_seed = [average_precision([run[clip] for clip in clips]) for run in judged_runs]
    false = [
        float(np.mean([share_reported(run, clips, [c for c in others if kind_of(c) == kind]) for run in runs]))
        for kind in ("bird", "drone")
    ]
    return (
        f"| {name} | {mean(clips):.2f} ({low:.2f} to {high:.2f}) | {mean(kinds['airplane']):.2f} | "
        f"{mean(kinds['helicopter']):.2f} ({heli_low:.2f} to {heli_high:.2f}) | {large:.2f} | {recall:.2f} | "
        f"{min(by_seed):.2f} to {max(by_seed):.2f} | {len(runs)} | {false[0]:.2f}, {false[1]:.2f} |"
    )


def report(folder):
    found = {}
    for path in sorted((folder / "found").glob("*.json")):
        arm, seed = path.stem.rsplit(".", 1)
        found.setdefault(arm, []).append(json.loads(path.read_text()))
    clips = [clip for clip in next(iter(found.values()))[0] if kind_of(clip) in ("airplane", "helicopter")]
    others = [clip for clip in next(iter(found.values()))[0] if clip not in clips]
    tuned, untouched = halves_of(clips)
    for title, half in (("untouched half", untouched), ("tuned half", tuned), ("all test clips", clips)):
        counts = ", ".join(f"{sum(kind_of(c) == kind for c in half)} of {kind}s" for kind in ("airplane", "helicopter"))
        print(f"\n{title}: {len(half)} clips, {counts}\n")
        print("| trained on | AP | airplanes | helicopters | boxes over 56 px | recall at 1 false alarm an image | from seed to seed | seeds | birds, drones |")
        print("|---|---|---|---|---|---|---|---|---|")
        for arm in list(arms_of(clips)) + list(MIXED):
            runs = found.get(arm.replace(" ", "-").replace(",", ""))
            if runs:
                print(row_of(arm, runs, half, others))


def brightness_of(folder, name):
    """Of each aircraft of 12 px or more before an even sky: 95th percentile of its luma less that of the sky, and
    whether a fiftieth of it is at 235 or more."""
    from train_detector import Images

    labels, root = labels_of(folder, name)
    images = Images(labels, root, name == "real", lambda image: True)
    found = []
    for pixels, boxes in zip(images.pixels, images.boxes):
        luma = np.asarray(pixels, float) @ [0.299, 0.587, 0.114]
        for x, y, width, height in boxes:
            if name == "real":  # drawn with a margin
                x, y, width, height = x + 6, y + 6, width - 12, height - 12
            left, top, right, bottom = int(x) - 4, int(y) - 4, int(x + width) + 4, int(y + height) + 4
            if max(width, height) < 12 or min(width, height) < 4 or left < 0 or top < 0:
                continue
            part = luma[top:bottom, left:right]
            if part.shape != (bottom - top, right - left):
                continue
            inner = np.zeros(part.shape, bool)
            inner[3:-3, 3:-3] = True
            sky = np.median(part[~inner])
            sd = 1.48 * np.median(np.abs(part[~inner] - sky))
            off = np.abs(part - sky) > max(6, 5 * sd)
            if sd <= 6 and off.sum() >= 10:
                found.append((np.percentile(part[off] - sky, 95), np.mean(part[off] >= 235) > 0.02))
    return np.array(found)


def bright(folder):
    for arm in arms_of(made_of(folder)):
        found = brightness_of(folder, arm)
        more = " ".join(f"{q:.0f}" for q in np.percentile(found[:, 0], [10, 25, 50, 75, 90]))
        print(f"{arm}: {len(found)} aircraft; brighter than the sky: {np.mean(found[:, 0] > 5):.2f}, clipped: "
              f"{np.mean(found[:, 1]):.2f}; percentiles 10 to 90 of by how much: {more}")


def main():
    command, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    if command == "make":
        make(folder, *sys.argv[3:5])
    elif command == "train":
        train_arm(folder, sys.argv[3], int(sys.argv[4]))
    elif command == "list":
        for seed in SEEDS:
            for arm in list(arms_of(made_of(folder))) + list(MIXED):
                print(f"{arm}\t{seed}")
    elif command == "bright":
        bright(folder)
    else:
        report(folder)


if __name__ == "__main__":
    main()

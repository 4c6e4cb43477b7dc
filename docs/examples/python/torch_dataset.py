# SPDX-License-Identifier: MIT
"""Frames of a project as a PyTorch data set, composed when they are asked for: torch_dataset.py PROJECT"""

import sys
from typing import Any

import torch
from torch.utils.data import DataLoader, Dataset

import sigs


class Encounter(Dataset[dict[str, Any]]):
    """Images float32 [3, rows, columns] in 0..1, boxes float32 [n, 4] as x1, y1, x2, y2, distances in metres."""

    def __init__(self, path: str) -> None:
        self.project = sigs.open(path)
        self.numbers = self.project.frame_range

    def __len__(self) -> int:
        return len(self.numbers)

    def __getitem__(self, i: int) -> dict[str, Any]:
        frame = self.project.render(self.numbers[i])
        seen = frame.truth.visible
        return {
            "image": torch.from_numpy(frame.rgb).permute(2, 0, 1).float() / 255,
            "boxes": torch.tensor([one.box.edges for one in seen if one.box]).float().reshape(-1, 4),
            "distance_m": torch.tensor([one.distance_m for one in seen]),
            "frame": frame.index,
        }


if __name__ == "__main__":
    loader = DataLoader(Encounter(sys.argv[1]), batch_size=4, shuffle=True, num_workers=2, collate_fn=list)
    batch = next(iter(loader))
    print(torch.stack([one["image"] for one in batch]).shape, [one["boxes"].tolist() for one in batch])

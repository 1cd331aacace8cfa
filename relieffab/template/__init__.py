"""A relief as a drawing at 1:1, to carve by hand: lines, depth contours, a scale."""

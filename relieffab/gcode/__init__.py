"""Motion to text and back, and the judgement of text."""

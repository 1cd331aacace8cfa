"""The studio: a local page on which a relief is tried and judged by eye before it is cut.

`session` is what one person has open; `preview` and `trial` work it out at the page's
size, on the one thread of `worker`.  Models come in through `upload`, jobs go out through
`exporting`, both in processes of their own.  `app` serves it, behind `guard`, by `serve`.
"""

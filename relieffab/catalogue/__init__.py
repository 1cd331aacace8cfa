"""Many jobs into one folder: what is asked, who carries it out, and the page that shows it."""

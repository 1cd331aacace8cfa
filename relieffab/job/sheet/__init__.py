"""report.html: a job as one page that needs nothing beside it, to read and to print."""

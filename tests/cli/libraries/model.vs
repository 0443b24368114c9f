(import (scheme base) (scheme write) (towers spiral))
(write (spiral 2)) (newline)

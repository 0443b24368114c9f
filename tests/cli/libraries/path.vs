(import (scheme base) (scheme write) (shapes deep) (hut))
(write (list (deep) (hut))) (newline)

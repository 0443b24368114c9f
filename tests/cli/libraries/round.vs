(import (scheme base) (round a))

(defined (omain d)
 (:types a - b
         d - d
         e - :key f))
